#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atmosphere/imported_path.h"
#include "radiometry/spectrum.h"

namespace ifov::atmosphere {

/// What another code computed for one atmosphere, one Sun and one line of sight from the ground to the
/// sensor.
struct ImportedRuns {
  std::vector<ImportedPath>
      runs;                    ///< one to three, over level Lambertian grounds that differ in albedo alone
  std::vector<double> albedo;  ///< of these grounds
  /// Runs that tell about the light above and at the ground alone, over black ground: the direct beam of the
  /// Sun, irradiances, the spherical albedo. They fill in what `runs` do not say, at their wavelengths.
  std::vector<ImportedPath> lights;
};

/// The Sun of the scene. Its irradiance stands in where the runs do not state theirs.
struct SunAbove {
  double cos_zenith = 1.0;          ///< at the ground, above 0
  radiometry::Spectrum irradiance;  ///< across the beam above the air, at the date's distance, W m-2 um-1
};

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

/// Whether the path says anything about the way to a sensor (else it may be one of ImportedRuns::lights).
bool sees_ground(const ImportedPath& path);

}  // namespace ifov::atmosphere
