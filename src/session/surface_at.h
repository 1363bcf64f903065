#pragma once

#include <optional>
#include <vector>

#include "materials/material.h"

namespace ifov::session {

/// Where all that a material's scattering depends on is known: the wavelengths between which it is linear, none where it is
/// the same at all. Throws InputError where `wavelength_um` is outside, or is needed and not given.
radiometry::CommonWavelengths wavelengths_of(const materials::Material& material,
                                             const std::optional<double>& wavelength_um);

/// A level surface of a material in some wavelengths; where the material has a direction, it is that of azimuth 0.
class SurfaceAt {
 public:
  SurfaceAt(const materials::Material& material, const std::vector<double>& wavelength_um);

  /// 1/sr, in the first wavelength, of light from azimuth 0. Angles from the normal, and counterclockwise from above; less
  /// than pi/2 from the normal. Not of a delta.
  double brdf(double light_rad, double view_rad, double azimuth_rad) const;

  /// In each wavelength, of light from this angle.
  struct Shares {
    std::vector<double> reflectance, transmittance, emissivity;  ///< no transmittance: opaque
  };
  Shares shares(double zenith_rad) const;

 private:
  const materials::Material& material_;
  std::size_t count_;
  std::vector<std::vector<float>> rows_;  ///< of the model's spectra
  std::vector<const float*> parameters_;
  std::vector<double> reflectance_, transmittance_;  ///< of a separable model
};

}  // namespace ifov::session
