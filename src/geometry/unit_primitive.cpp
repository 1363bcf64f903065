#include "geometry/unit_primitive.h"

#include <algorithm>
#include <cmath>

namespace ifov::geometry {

using math::Vec3;

double largest_stretch(const math::Transform& map) {
  const Vec3 x = map.column_x(), y = map.column_y(), z = map.column_z();
  const double xy = std::abs(dot(x, y)), xz = std::abs(dot(x, z)), yz = std::abs(dot(y, z));
  return std::sqrt(std::max({dot(x, x) + xy + xz, dot(y, y) + xy + yz, dot(z, z) + xz + yz}));
}

}  // namespace ifov::geometry
