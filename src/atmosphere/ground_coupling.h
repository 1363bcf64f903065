#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atmosphere/imported_path.h"

namespace ifov::atmosphere {

/// A run over a level Lambertian ground of one albedo.
struct AlbedoRun {
  double albedo = 0.0;
  const ImportedPath* path = nullptr;
};

/// How the radiance of a path depends on the albedo r of a uniform Lambertian ground:
///   L(r) = path_radiance + reflected r / (1 - r spherical_albedo)
/// (Vermote et al. 1997, IEEE TGRS 35, 675, eq. 1). `reflected` is T_up E / pi with the irradiance E of the
/// ground without its own light. Radiances in W m-2 sr-1 um-1.
struct GroundCoupling {
  std::vector<double> wavelength_um;
  std::vector<double> path_radiance;
  std::vector<double> reflected;
  std::vector<double> direct_reflected;  ///< the part that comes from the point looked at; empty if unknown
  std::vector<double> spherical_albedo;
  /// Wavelengths at which rounding in the files took the spherical albedo out of [0, 1), where it was cut.
  std::size_t cut = 0;

  double radiance(std::size_t wavelength, double albedo) const;
};

/// The closed form from three runs of different albedo, or from two runs one of which has a column of
/// spherical albedos, or from two runs of albedo above 0 that state what the ground reflects. The light is
/// solar_path_radiance + ground_reflected_radiance where all runs have both, else total_radiance (good where
/// the ground emits nothing). Throws InputError, naming the runs, for other numbers of runs, equal albedos,
/// albedos outside [0, 1] and wavelengths that differ.
GroundCoupling ground_coupling(std::span<const AlbedoRun> runs);

}  // namespace ifov::atmosphere
