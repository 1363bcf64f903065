#pragma once

#include <cstdint>

#include "render/views/sun_share.h"

namespace ifov::sampling {
struct TileResult;
}
namespace ifov::sensor {
class SingleView;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class AccuracyTolerance;

/// Turns the mean radiance of a sensor::HemisphereView's pixel, channels alone, into the irradiance on its plane, W m-2 um-1: pi
/// times it, and the Sun's, which no ray meets. Of that what stands before its disc is sampled on its own
/// (sampling::replicated_mean). Sunlight that comes through panes or by flat mirrors is not told: its most widens the half-widths and marks the pixel
/// with Reason::unseen_light. `tolerance` may be null; it judges the radiance of a white Lambertian there, irradiance over pi.
void to_irradiance(const transport::SpectralScene& scene, const sensor::SingleView& view,
                   const AccuracyTolerance* tolerance, const ThroughPanes& through_panes, std::uint64_t seed,
                   sampling::TileResult& tile);

}  // namespace ifov::render
