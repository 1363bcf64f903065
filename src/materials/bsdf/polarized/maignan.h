#pragma once

#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/facet_reflection.h"

namespace ifov::materials {

/// Soil and vegetation with the light that their surfaces polarize (Maignan, Breon, Fedele and Bouvier 2009,
/// Polarized reflectances of natural surfaces, Remote Sens. Environ. 113, 2642):
///   pi f = reflectance + C exp(-tan c) exp(-NDVI) F(c) / (4 (cos out + cos in)),
/// with F Fresnel's matrix at the angle of incidence c, half of that between the directions. Light of the
/// reflectance is unpolarized.
class Maignan final : public Bsdf {
 public:
  static const BsdfModel kModel;
  Maignan(const radiometry::Spectrum& reflectance, double coefficient, double ndvi,
          const radiometry::Spectrum& n);

  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override { return polarization_; }
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

 private:
  FacetReflection reflection(const BsdfEvent& event) const;

  double level_;                               // C exp(-NDVI) / (4 pi)
  std::vector<radiometry::Spectrum> spectra_;  // FresnelRows, the reflectance
  std::vector<radiometry::Spectrum> polarization_;
};

}  // namespace ifov::materials
