#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace ifov::radiometry {
class SpectralNodes;
}

namespace ifov::atmosphere {

/// Light that comes down on level ground and leaves it. Azimuths are those of propagation, as in Propagation.
struct GroundEvent {
  double out_mu = 1.0, in_mu = -1.0;  ///< > 0 going up, < 0 coming down
  double out_azimuth_rad = 0.0, in_azimuth_rad = 0.0;
};

/// Of (I, Q, U) about the meridional frames of both directions: [row][column], 1/sr.
using GroundMatrix = std::array<std::array<double, 3>, 3>;

/// The same ground in the nodes of a sensor.
class GroundAtNodes {
 public:
  virtual ~GroundAtNodes() = default;
  /// Share that it reflects of light that comes down with cosine `mu` (> 0) from the zenith, mean over azimuths, by node.
  virtual void albedo(double mu, std::span<double> nodes) const = 0;
  /// Adds to `light` what the ground makes of `incoming` (radiance, times cosine and solid angle); both are [I, Q, U][node], or
  /// [I][node] where neither tells polarization.
  virtual void add_reflected(const GroundEvent& event, std::span<const double> incoming,
                             std::span<double> light) const = 0;
};

/// Level ground, the same everywhere, that reflects by direction.
class DirectionalGround {
 public:
  virtual ~DirectionalGround() = default;

  /// Whether the BRDF depends on the difference of azimuths alone, and is the same on both sides of the plane of incidence.
  virtual bool is_isotropic() const = 0;
  virtual bool polarizes() const = 0;
  /// The BRDF at a wavelength; of ground that does not polarize element 0, 0 alone is not 0. Spans are as long as each other.
  virtual void reflect(double wavelength_um, std::span<const GroundEvent> events,
                       std::span<GroundMatrix> brdf) const = 0;

  /// The same ground in the nodes of a sensor.
  virtual std::shared_ptr<const GroundAtNodes> at(const radiometry::SpectralNodes& nodes,
                                                  bool polarized) const = 0;
};

}  // namespace ifov::atmosphere
