#pragma once

#include "materials/scattering.h"

namespace ifov::materials {

/// Lambert (1760): the same radiance to all sides, BRDF = reflectance / pi. Sampled in proportion to the
/// cosine, so that the weight is 1.
class Lambertian final : public Scattering {
 public:
  bool is_delta() const override { return false; }
  ScatterSample sample(math::Vec3 outgoing, math::Normal3 normal, double u1, double u2) const override;
  double evaluate(math::Vec3 outgoing, math::Vec3 incoming, math::Normal3 normal) const override;
  double pdf(math::Vec3 outgoing, math::Vec3 incoming, math::Normal3 normal) const override;
  UnitSquarePoint invert(math::Vec3 outgoing, math::Vec3 incoming, math::Normal3 normal) const override;
};

}  // namespace ifov::materials
