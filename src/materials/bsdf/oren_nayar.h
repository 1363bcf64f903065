#pragma once

#include <array>

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// A rough surface of Lambertian facets in V-shaped grooves, slopes Gaussian and isotropic, with shadowing, masking and
/// light that goes from facet to facet: the qualitative model's full form of Oren and Nayar 1994 (Generalization of
/// Lambert's reflectance model, SIGGRAPH '94, eqs. 27 to 30). The material's reflectance is that of the facets; the
/// surface as a whole reflects less.
class OrenNayar final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// `slope_rad`: standard deviation of the facets' slope angle, 0 (Lambertian) to pi/2.
  OrenNayar(radiometry::Spectrum reflectance, double slope_rad);

  std::span<const radiometry::Spectrum> spectra() const override { return reflectance_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

  /// BRDF = reflectance x [0] + reflectance^2 x [1], 1/sr.
  std::array<double, 2> terms(const BsdfEvent& event) const;

 private:
  std::array<radiometry::Spectrum, 1> reflectance_;
  double c1_, c2_, c3_, again_;
};

}  // namespace ifov::materials
