#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace ifov::math {
struct Ray;
}
namespace ifov::sampling {
struct RayCounts;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// Whether a ray that something blocks goes straight on through panes; empty: nothing lets any pass.
using ThroughPanes = std::function<bool(const math::Ray& blocked, sampling::RayCounts& counts)>;

/// Of the Sun's irradiance on a surface that faces it, what reaches the plane: the cosine, and what of the disc is free.
struct SunShare {
  double cosine = 0.0;  ///< mean over the free part of the disc times its share
  double standard_error = 0.0, half_width = 0.0;
  double unfound = 0.0;  ///< the most that comes through panes and by flat mirrors besides
};

/// At the plane whose origin and normal `along` is; to about `limit`, by sampling::replicated_mean.
SunShare share_of_sun(const transport::SpectralScene& scene, const math::Ray& along,
                      const ThroughPanes& through_panes, double limit, double confidence, std::uint64_t seed,
                      sampling::RayCounts& counts);

/// By channel, on a surface that faces the Sun, W m-2 um-1.
std::vector<double> sunlight_by_channel(const transport::SpectralScene& scene);

/// The cosine of the Sun's direction to a normal, at least 0; 0 too where there is none above the horizon.
double sun_cosine(const transport::SpectralScene& scene, const math::Ray& along);

}  // namespace ifov::render
