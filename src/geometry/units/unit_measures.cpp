#include "geometry/units/unit_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::geometry::units {

using math::Point3;
using math::Vec3;

// From the point of closest approach: the textbook discriminant loses all digits when the start is far away.
Crossings round_crossings(Point3 p, Vec3 d, bool spherical) {
  const double pz = spherical ? p.z : 0.0, dz = spherical ? d.z : 0.0;
  const double dd = d.x * d.x + d.y * d.y + dz * dz;
  if (!(dd > 0.0)) return {};
  const double closest = -(p.x * d.x + p.y * d.y + pz * dz) / dd;
  const double qx = p.x + closest * d.x, qy = p.y + closest * d.y, qz = pz + closest * dz;
  const double rest = 1.0 - (qx * qx + qy * qy + qz * qz);
  if (!(rest > 0.0)) return {};
  const double half = std::sqrt(rest / dd);
  return {{closest - half, closest + half}};
}

World::Bounds bounds_by_coordinate(const math::Transform& m,
                                   std::pair<double, double> (*span)(const Extent& extent)) {
  const Vec3 x = m.column_x(), y = m.column_y(), z = m.column_z();
  const Point3 o = m.origin_m();
  const auto [x_low, x_high] = span({o.x, std::hypot(x.x, y.x), z.x});
  const auto [y_low, y_high] = span({o.y, std::hypot(x.y, y.y), z.y});
  const auto [z_low, z_high] = span({o.z, std::hypot(x.z, y.z), z.z});
  return {{x_low, y_low, z_low}, {x_high, y_high, z_high}};
}

// |w + M e|^2 <= |w|^2 + 2 |M^T w| + |M|^2 for unit vectors e: exact where w is orthogonal or M a similarity.
double ball_reach_m(const math::Transform& object_from_unit, Point3 from_m) {
  const Vec3 x = object_from_unit.column_x(), y = object_from_unit.column_y(),
             z = object_from_unit.column_z();
  const Vec3 w = object_from_unit.origin_m() - from_m;
  const double stretch = largest_stretch(object_from_unit);
  return std::sqrt(dot(w, w) + 2.0 * math::length({dot(x, w), dot(y, w), dot(z, w)}) + stretch * stretch);
}

double rim_reach_m(const math::Transform& object_from_unit, Point3 from_m, double height) {
  const Vec3 x = object_from_unit.column_x(), y = object_from_unit.column_y(),
             z = object_from_unit.column_z();
  const Vec3 w = object_from_unit.origin_m() - from_m;
  const Vec3 v = height == 0.0 ? w : w + z * height;
  const double stretch2 = std::max(dot(x, x), dot(y, y)) + std::abs(dot(x, y));
  return std::sqrt(dot(v, v) + 2.0 * std::hypot(dot(x, v), dot(y, v)) + stretch2);
}

double turn_of(Point3 p) {
  const double a = std::atan2(p.y, p.x) / (2.0 * std::numbers::pi);
  return a < 0.0 ? a + 1.0 : a;
}

double half_of(double x) { return std::clamp(0.5 * (x + 1.0), 0.0, 1.0); }

}  // namespace ifov::geometry::units
