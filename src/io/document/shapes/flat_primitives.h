#pragma once

#include <vector>

#include "io/document/shapes/primitive.h"

namespace ifov::io {

/// A horizontal plane without end, facing up.
struct PlanePrimitive final : PrimitiveSettings {
  static const PrimitiveModel kModel;
  double height_m = 0.0;
  Built build() const override { return {geometry::Plane{height_m}}; }
};

struct DiskPrimitive final : PrimitiveSettings {
  static const PrimitiveModel kModel;
  math::Point3 centre_m;
  math::Vec3 normal;  ///< towards the front; any length above zero
  double radius_m = 0.0;
  Built build() const override;
};

/// Planar, concave allowed, not crossing itself; the front is where the vertices run counter-clockwise.
struct PolygonPrimitive final : PrimitiveSettings {
  static const PrimitiveModel kModel;
  std::vector<math::Point3> vertices_m;
  Built build() const override { return {geometry::Polygon{vertices_m}}; }
};

}  // namespace ifov::io
