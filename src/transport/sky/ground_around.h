#pragma once

#include <cstddef>
#include <vector>

namespace ifov::radiometry {
struct StokesVector;
}
namespace ifov::atmosphere {
class SensorAtmosphere;
}

namespace ifov::transport {

/// What the ground around the scene sends into the air, by node, and what the air has of it on the whole.
struct GroundAround {
  std::vector<double> even;    ///< radiance, alike in every direction
  std::vector<double> shaped;  ///< as SensorAtmosphere::directional() says, over pi; empty: none

  double sky(const atmosphere::SensorAtmosphere& air, std::size_t zenith, std::size_t azimuth,
             std::size_t node) const;
  radiometry::StokesVector sky_stokes(const atmosphere::SensorAtmosphere& air, std::size_t zenith,
                                      std::size_t azimuth, std::size_t node) const;
  /// What comes of it into a line of sight: radiance, and with its polarization about the line's meridional frame.
  double path(const atmosphere::SensorAtmosphere& air, std::size_t line, std::size_t node) const;
  radiometry::StokesVector path_stokes(const atmosphere::SensorAtmosphere& air, std::size_t line,
                                       std::size_t node) const;
};

}  // namespace ifov::transport
