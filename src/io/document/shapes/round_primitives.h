#pragma once

#include "io/document/shapes/primitive.h"

namespace ifov::io {

struct SpherePrimitive final : PrimitiveSettings {
  static const PrimitiveModel kModel;
  math::Point3 centre_m;
  double radius_m = 0.0;
  Built build() const override { return {geometry::Sphere{centre_m, radius_m}}; }
};

/// The upper half (+z) of a sphere, without a floor.
struct HemispherePrimitive final : PrimitiveSettings {
  static const PrimitiveModel kModel;
  math::Point3 centre_m;
  double radius_m = 0.0;
  Built build() const override { return {geometry::Hemisphere{centre_m, radius_m}}; }
};

struct CylinderPrimitive final : PrimitiveSettings {
  static const PrimitiveModel kModel;
  math::Point3 base_m;  ///< centre of the base
  math::Vec3 axis_m;    ///< from the centre of the base to the centre of the top
  double radius_m = 0.0;
  bool capped = true;
  Built build() const override;
};

}  // namespace ifov::io
