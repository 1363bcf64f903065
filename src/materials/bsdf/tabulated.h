#pragma once

#include <memory>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/bsdf_table.h"

namespace ifov::materials {

/// A BRDF as measured, linear between the angles of its table and between its wavelengths. The material's reflectance is a
/// factor: 1 for the surface as it was measured.
class Tabulated final : public Bsdf {
 public:
  static const BsdfModel kModel;
  Tabulated(const radiometry::Spectrum& reflectance, std::shared_ptr<const BsdfTable> table);

  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

 private:
  std::shared_ptr<const BsdfTable> table_;
  std::vector<radiometry::Spectrum> spectra_;  // the factor; then the table's rows over `largest_`
  double largest_ = 0.0;                       // 1/sr
};

}  // namespace ifov::materials
