#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "radiometry/spectrum.h"

namespace ifov::materials {

class Bsdf;

/// The model of a material that names none: Lambert's.
const std::shared_ptr<const Bsdf>& usual_bsdf();

/// A surface, the same on both sides: opaque, or a thin leaf that also lets light through.
struct Material {
  std::string name;
  /// Directional-hemispherical reflectance, 0 to 1.
  radiometry::Spectrum reflectance;
  /// How it spreads light; never null. Where it is not separable, reflectance and transmittance are its bihemispherical
  /// ones, for whoever needs one number by wavelength.
  std::shared_ptr<const Bsdf> bsdf = usual_bsdf();
  /// Kelvin. None: the surface does not emit (a reflective-only scene), unless a temperature map says
  /// otherwise.
  std::optional<double> temperature_k = std::nullopt;
  /// Directional-hemispherical transmittance of a thin leaf whose light leaves the other side as Lambert's law says
  /// (bi-Lambertian; Ross 1981). None: opaque. Emissivity, on both sides, is 1 - reflectance - transmittance
  /// (Kirchhoff).
  std::optional<radiometry::Spectrum> transmittance = std::nullopt;
  std::optional<bool> emitter =
      std::nullopt;  ///< light is sought from it; none: where it is twice as bright as the scene
  /// Index of the material whose further curve this is (a texture picks among them); it must have none itself.
  /// Labels and truth count this as that one.
  std::optional<std::uint32_t> curve_of = std::nullopt;
};

/// Throws InputError, naming the material, where a reflectance or transmittance leaves [0, 1] or their sum exceeds 1
/// by more than 1e-9, where a model transmits that cannot, or where a temperature is not above 0 K.
void check(const Material& material);

/// Bsdf::holds_to_um() of its model.
double holds_to_um(const Material& material);

}  // namespace ifov::materials
