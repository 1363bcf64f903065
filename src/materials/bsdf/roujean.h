#pragma once

#include <array>

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// Roujean, Leroy and Deschamps 1992 (A bidirectional reflectance model of the Earth's surface for the correction of remote
/// sensing data, J. Geophys. Res. 97, D18): a level, vertical protrusions with their shadows, and a volume of facets. BRDF =
/// (k0 + k1 f1 + k2 f2) / pi, 0 where that is negative. The material's reflectance is k0. Directions as ReflectionAngles has
/// them.
class Roujean final : public Bsdf {
 public:
  static const BsdfModel kModel;
  Roujean(radiometry::Spectrum level, radiometry::Spectrum geometric, radiometry::Spectrum volumetric);

  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

  /// f1 and f2.
  static std::array<double, 2> kernels(const BsdfEvent& event);

 private:
  std::array<radiometry::Spectrum, 3> spectra_;
};

}  // namespace ifov::materials
