#pragma once

#include <array>

#include "math/vec3.h"

namespace ifov::math {

/// An affine map between two frames, named destination_from_source: `scene_from_object(p)`. Rotation,
/// translation and scale (also unequal and mirrored); it must be invertible wherever `inverse` or a normal is
/// asked for.
class Transform {
 public:
  constexpr Transform() = default;

  static Transform translation(Vec3 by_m);
  static Transform scaling(Vec3 factors);
  /// Right-handed rotation about `axis` (any length but zero) through the origin.
  static Transform rotation(Vec3 axis, double angle_rad);
  /// The map whose linear part has these columns: where it takes the unit vectors x, y, z, and the origin.
  static constexpr Transform from_columns(Vec3 x, Vec3 y, Vec3 z, Point3 origin_m) {
    Transform t;
    t.x_ = x, t.y_ = y, t.z_ = z, t.origin_m_ = origin_m;
    return t;
  }

  constexpr Point3 operator()(Point3 p) const { return origin_m_ + x_ * p.x + y_ * p.y + z_ * p.z; }
  constexpr Vec3 operator()(Vec3 v) const { return x_ * v.x + y_ * v.y + z_ * v.z; }
  /// By the inverse transpose; the result has length 1.
  Normal3 operator()(Normal3 n) const;

  Transform inverse() const;
  /// Negative where the map mirrors; zero where it has no inverse.
  constexpr double determinant() const { return dot(x_, cross(y_, z_)); }

  constexpr Vec3 column_x() const { return x_; }
  constexpr Vec3 column_y() const { return y_; }
  constexpr Vec3 column_z() const { return z_; }
  constexpr Point3 origin_m() const { return origin_m_; }

  /// c_from_a = c_from_b * b_from_a.
  friend constexpr Transform operator*(const Transform& a, const Transform& b) {
    return from_columns(a(b.x_), a(b.y_), a(b.z_), a(b.origin_m_));
  }
  friend constexpr bool operator==(const Transform&, const Transform&) = default;

 private:
  Vec3 x_{1.0, 0.0, 0.0}, y_{0.0, 1.0, 0.0}, z_{0.0, 0.0, 1.0};
  Point3 origin_m_{};
};

}  // namespace ifov::math
