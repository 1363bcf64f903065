#pragma once

#include <vector>

#include "atmosphere/sensor/atmosphere_error.h"
#include "atmosphere/sensor/channel_scattering.h"
#include "atmosphere/sensor/finer_atmosphere.h"
#include "atmosphere/sensor/kept_solutions.h"

namespace ifov::atmosphere {

/// Solves the points of a channel at which interpolation between its solutions is worst by themselves and
/// with more care, and says how far what was interpolated is from that. Keeps references.
class ChannelChecks {
 public:
  ChannelChecks(const ChannelScattering& scattering, const ChannelPoints& points,
                const SensorGeometry& geometry, const FinerAtmosphere& air);

  std::size_t solutions() const { return checks_.size(); }
  /// Different ones may be solved at the same time.
  void solve(const ColumnSolver& finer, std::size_t solution, KeptSolutions* kept);

  /// Relative errors of what the points were given, weighted with their light.
  struct Errors {
    double path = 0.0, sky_irradiance = 0.0, diffuse_transmittance = 0.0, spherical_albedo = 0.0;
  };
  Errors against(const ChannelScattering::AtPoints& given) const;

 private:
  struct Check {
    ChannelScattering::WeakPoint at;
    // For sunlight of 1 above the air.
    double path = 0.0, sky_irradiance = 0.0, diffuse_transmittance = 0.0, spherical_albedo = 0.0;
  };
  const ChannelPoints& points_;
  const SensorGeometry& geometry_;
  const FinerAtmosphere& air_;
  std::vector<Check> checks_;
};

}  // namespace ifov::atmosphere
