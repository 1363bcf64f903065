#pragma once

#include "materials/scattering.h"

namespace ifov::materials {

/// A plane mirror: all light leaves at the angle at which it came.
class Mirror final : public Scattering {
 public:
  bool is_delta() const override { return true; }
  ScatterSample sample(math::Vec3 outgoing, math::Normal3 normal, double u1, double u2) const override;
  double evaluate(math::Vec3, math::Vec3, math::Normal3) const override { return 0.0; }
  double pdf(math::Vec3, math::Vec3, math::Normal3) const override { return 0.0; }
  UnitSquarePoint invert(math::Vec3, math::Vec3, math::Normal3) const override { return {0.5, 0.5}; }
};

}  // namespace ifov::materials
