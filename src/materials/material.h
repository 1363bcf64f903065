#pragma once

#include <optional>
#include <string>

#include "materials/scattering.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

/// An opaque surface.
struct Material {
  std::string name;
  /// Directional-hemispherical reflectance, 0 to 1. Emissivity is 1 minus it (Kirchhoff).
  radiometry::Spectrum reflectance;
  ScatteringKind scattering = ScatteringKind::lambertian;
  /// Kelvin. None: the surface does not emit (a reflective-only scene), unless a temperature map says
  /// otherwise.
  std::optional<double> temperature_k;
};

/// Throws InputError, naming the material, where a reflectance leaves [0, 1] by more than 1e-9 or a
/// temperature is not above 0 K.
void check(const Material& material);

}  // namespace ifov::materials
