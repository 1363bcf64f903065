#include "math/transform.h"

#include <cassert>

namespace ifov::math {

Transform Transform::translation(Vec3 by_m) {
  return from_columns({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {by_m.x, by_m.y, by_m.z});
}

Transform Transform::scaling(Vec3 factors) {
  return from_columns({factors.x, 0.0, 0.0}, {0.0, factors.y, 0.0}, {0.0, 0.0, factors.z}, {});
}

Transform Transform::rotation(Vec3 axis, double angle_rad) {
  const Vec3 k = normalized(axis);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const auto turned = [&](Vec3 v) {
    return v * c + cross(k, v) * s + k * (dot(k, v) * (1.0 - c));
  };  // Rodrigues
  return from_columns(turned({1.0, 0.0, 0.0}), turned({0.0, 1.0, 0.0}), turned({0.0, 0.0, 1.0}), {});
}

Normal3 Transform::operator()(Normal3 n) const {
  const Vec3 cofactors = cross(y_, z_) * n.x + cross(z_, x_) * n.y + cross(x_, y_) * n.z;
  return as_normal(normalized(determinant() < 0.0 ? -cofactors : cofactors));
}

Transform Transform::inverse() const {
  assert(determinant() != 0.0);
  const double scale = 1.0 / determinant();
  const Vec3 row_x = cross(y_, z_) * scale, row_y = cross(z_, x_) * scale, row_z = cross(x_, y_) * scale;
  const Vec3 o{origin_m_.x, origin_m_.y, origin_m_.z};
  return from_columns({row_x.x, row_y.x, row_z.x}, {row_x.y, row_y.y, row_z.y}, {row_x.z, row_y.z, row_z.z},
                      {-dot(row_x, o), -dot(row_y, o), -dot(row_z, o)});
}

}  // namespace ifov::math
