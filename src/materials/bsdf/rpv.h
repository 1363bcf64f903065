#pragma once

#include <optional>
#include <vector>

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// Vegetation and soil seen from afar: Rahman, Pinty and Verstraete 1993 (Coupled surface-atmosphere reflectance model 2,
/// J. Geophys. Res. 98, D11), which fits measured reflectance by three factors: bowl or bell (Minnaert 1941), forward or
/// backward (Henyey and Greenstein 1941), and hot spot. The material's reflectance is rho0, the level, which is not the
/// surface's reflectance as a whole. Directions as ReflectionAngles has them.
class Rpv final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// `k`: below 1 a bowl, brighter to the sides; above 1 a bell. `asymmetry`: -1 to 1, of the cosine of the angle by which
  /// light is turned; below 0 more of it goes back. `hot_spot`: rho_c, 0 to 1, the lower the brighter the hot
  /// spot; none: rho0.
  Rpv(radiometry::Spectrum rho0, double k, double asymmetry,
      std::optional<radiometry::Spectrum> hot_spot = std::nullopt);

  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

 private:
  std::vector<radiometry::Spectrum> spectra_;
  double k_, asymmetry_;
};

}  // namespace ifov::materials
