#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/bsdf_table.h"

namespace ifov::materials {

/// A BRDF as measured, and a BTDF beside it if there is one, linear between the angles of their tables and between wavelengths. The
/// material's reflectance is a factor on both: 1 for the surface as it was measured.
class Tabulated final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// `transmitted` may be null: opaque. `direction_rad`: of azimuth 0 of tables that are not isotropic, from the tangent, counterclockwise as
  /// seen from the front.
  Tabulated(const radiometry::Spectrum& reflectance, std::shared_ptr<const BsdfTable> reflected,
            std::shared_ptr<const BsdfTable> transmitted = nullptr, double direction_rad = 0.0);

  bool is_isotropic() const override;
  /// As seen from there the direction of the tables lies on the other side of the tangent.
  std::shared_ptr<const Bsdf> behind() const override;
  bool may_transmit() const override { return sides_[1].table != nullptr; }
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

 private:
  struct OfSide {
    std::shared_ptr<const BsdfTable> table;
    std::size_t first = 0;  // of its rows in spectra_, each over `largest`
    double largest = 0.0;   // 1/sr
  };
  void add(std::shared_ptr<const BsdfTable> table, OfSide& side);

  std::array<OfSide, 2> sides_;                // reflected, transmitted
  std::vector<radiometry::Spectrum> spectra_;  // the factor; then rows
  double direction_rad_;
};

}  // namespace ifov::materials
