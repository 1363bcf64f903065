#pragma once

#include <vector>

#include "atmosphere/sensor/atmosphere_error.h"
#include "atmosphere/sensor/channel_scattering.h"
#include "atmosphere/sensor/finer_atmosphere.h"
#include "atmosphere/sensor/kept_solutions.h"

namespace ifov::atmosphere {

struct ChannelEmission;

/// Solves the points of a channel at which interpolation between its solutions is worst by themselves and
/// with more care, and says how far what was interpolated is from that. Keeps references.
class ChannelChecks {
 public:
  /// `glows`: whether what the air emits is scattered in it, and to be judged.
  ChannelChecks(const ChannelScattering& scattering, const ChannelPoints& points,
                const SensorGeometry& geometry, const FinerAtmosphere& air, bool glows = false);

  std::size_t solutions() const { return checks_.size(); }
  /// Different ones may be solved at the same time.
  void solve(const ColumnSolver& finer, std::size_t solution, KeptSolutions* kept);

  /// Relative errors of what the points were given, weighted with their light; of what the air emits the largest.
  struct Errors {
    double path = 0.0, sky_irradiance = 0.0, diffuse_transmittance = 0.0, spherical_albedo = 0.0;
    double emitted_path = 0.0, emitted_sky = 0.0;  ///< of what the air emits itself
  };
  /// `emitted`: null where the channel's air does not glow.
  Errors against(const ChannelScattering::AtPoints& given, const ChannelEmission* emitted = nullptr) const;

 private:
  struct Check {
    ChannelScattering::WeakPoint at;
    // For sunlight of 1 above the air.
    double path = 0.0, sky_irradiance = 0.0, diffuse_transmittance = 0.0, spherical_albedo = 0.0;
    double emitted_path = 0.0, emitted_sky = 0.0;  // W m-2 sr-1 um-1, W m-2 um-1
  };
  void solve_emission(const ScatteringOptions& options, const Levels& levels, const LayerOptics& optics,
                      Check& check, KeptSolutions* kept) const;
  const ChannelPoints& points_;
  const SensorGeometry& geometry_;
  const FinerAtmosphere& air_;
  bool glows_;
  std::vector<Check> checks_;
};

}  // namespace ifov::atmosphere
