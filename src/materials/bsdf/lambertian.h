#pragma once

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// Lambert (1760): the same radiance to all sides, BRDF = reflectance / pi, and likewise what a thin leaf transmits
/// (bi-Lambertian; Ross 1981). Sampled in proportion to the cosine, so that the weight is 1.
class Lambertian final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// The one object: all Lambertian materials of a surface add up.
  static const std::shared_ptr<const Bsdf>& shared();

  bool is_separable() const override { return true; }
  bool is_lambertian() const override { return true; }
  bool may_transmit() const override { return true; }
  double shape(const BsdfEvent& event) const override;
};

}  // namespace ifov::materials
