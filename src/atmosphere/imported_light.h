#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atmosphere/imported_runs.h"

namespace ifov::atmosphere {

/// Light over black ground, and how the ground's own light comes back: all that a renderer needs. The
/// radiance of a uniform Lambertian plain of albedo r is
///   L(r) = path + (view + diffuse_transmittance) (sun cos + sky) / pi * r / (1 - r spherical_albedo)
/// as that of the runs (Vermote et al. 1997, IEEE TGRS 35, 675). `sun` and `sky` are as the sensor sees them
/// reflected: the two-way transmittance of a band is not the product of those of its ways, so the ratio C =
/// T_two-way / (T_sun T_view) is part of them.
struct ImportedLight {
  std::string source;  ///< the runs, for messages
  std::vector<double> wavelength_um;
  std::vector<double> width_um;  ///< of channels; empty for a spectrum
  std::vector<double> sun;       ///< direct, across the beam, W m-2 um-1
  std::vector<double> sky;       ///< irradiance of level ground, W m-2 um-1; empty: the runs do not say
  std::vector<double> view;      ///< direct transmittance from the ground to the sensor
  std::vector<double> diffuse_transmittance;  ///< of light that scatters on that way
  std::vector<double> path;                   ///< radiance that the path adds, W m-2 sr-1 um-1
  std::vector<double> spherical_albedo;
  bool own_irradiance = false;       ///< the irradiance of SunAbove counts for nothing
  std::vector<std::string> remarks;  ///< what is taken for granted, one sentence each
};

/// Throws InputError that names the quantity that is missing, the run and what to do; also for runs that look
/// up, or under another Sun than `sun` by more than a degree. Without `sun` the runs must hold no direct
/// sunlight.
ImportedLight imported_light(const ImportedRuns& given, const std::optional<SunAbove>& sun);

}  // namespace ifov::atmosphere
