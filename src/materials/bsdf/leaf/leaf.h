#pragma once

#include <array>
#include <memory>

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// A leaf by what it is made of (PROSPECT): the same radiance to all sides, on that of the light and on the other. With a layer of wax
/// its surface shines besides (WaxedLeaf).
class Leaf final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// Shares of all light.
  Leaf(radiometry::Spectrum reflectance, radiometry::Spectrum transmittance);

  bool may_transmit() const override { return true; }
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

 private:
  std::array<radiometry::Spectrum, 2> spectra_;
};

}  // namespace ifov::materials
