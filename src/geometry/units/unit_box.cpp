#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/units/unit_measures.h"

namespace ifov::geometry::units {
namespace {

using math::Normal3;
using math::Point3;
using math::Transform;
using math::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

UnitHit intersect_box(Point3 p, Vec3 d, double t_min, double t_max) {
  const double pos[3] = {p.x, p.y, p.z}, dir[3] = {d.x, d.y, d.z};
  double enter = -kInfinity, leave = kInfinity;
  std::uint32_t enter_face = 0, leave_face = 0;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (dir[axis] == 0.0) {
      if (std::abs(pos[axis]) > 1.0) return {};
      continue;
    }
    const double low = (-1.0 - pos[axis]) / dir[axis], high = (1.0 - pos[axis]) / dir[axis];
    const bool rising = dir[axis] > 0.0;
    const double first = rising ? low : high, last = rising ? high : low;
    if (first > enter) enter = first, enter_face = 2 * axis + (rising ? 0 : 1);
    if (last < leave) leave = last, leave_face = 2 * axis + (rising ? 1 : 0);
  }
  if (enter > leave) return {};
  if (enter > t_min && enter < t_max) return {enter, enter_face};
  if (leave > t_min && leave < t_max) return {leave, leave_face};
  return {};
}

Normal3 box_normal(std::uint32_t face, Point3) {
  const double side = face % 2 == 0 ? -1.0 : 1.0;
  return {face / 2 == 0 ? side : 0.0, face / 2 == 1 ? side : 0.0, face / 2 == 2 ? side : 0.0};
}

Uv box_uv(std::uint32_t face, Point3 p) {
  return {half_of(face / 2 == 0 ? p.y : p.x), half_of(face / 2 == 2 ? p.y : p.z)};
}

World::Bounds box_bounds(const Transform& m) {
  const Vec3 x = m.column_x(), y = m.column_y(), z = m.column_z();
  const Vec3 reach{std::abs(x.x) + std::abs(y.x) + std::abs(z.x),
                   std::abs(x.y) + std::abs(y.y) + std::abs(z.y),
                   std::abs(x.z) + std::abs(y.z) + std::abs(z.z)};
  return {m.origin_m() - reach, m.origin_m() + reach};
}

double box_reach_m(const Transform& m, Point3 from_m) {
  const Vec3 x = m.column_x(), y = m.column_y(), z = m.column_z();
  const Vec3 w = m.origin_m() - from_m;
  double reach = 0.0;
  for (int corner = 0; corner < 8; ++corner)
    reach = std::max(reach, length(w + x * (corner & 1 ? 1.0 : -1.0) + y * (corner & 2 ? 1.0 : -1.0) +
                                   z * (corner & 4 ? 1.0 : -1.0)));
  return reach;
}

void box_flats(const UnitFlatVisitor& visitor) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 unit[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
      visitor(unit[axis] * side, Point3{} + unit[axis] * side, unit[(axis + 1) % 3], unit[(axis + 2) % 3]);
    }
}

void box_pieces(const Transform& map, const UnitPieceVisitor& visitor) {
  for (std::uint32_t k = 0; k < 6; ++k) {
    const double side = k % 2 == 0 ? -1.0 : 1.0;
    Vec3 axis[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const Vec3 out = axis[k / 2] * side;
    Vec3 x = axis[(k / 2 + 1) % 3], y = axis[(k / 2 + 2) % 3];
    if (side < 0.0) std::swap(x, y);
    visitor(PieceKind::parallelogram, k,
            map * Transform::from_columns(2.0 * x, 2.0 * y, out, Point3{} + (out - x - y)), true);
  }
}

}  // namespace

constinit const UnitShape kBox{.faces = 6,
                               .intersect = intersect_box,
                               .normal = box_normal,
                               .uv = box_uv,
                               .bounds = box_bounds,
                               .reach_m = box_reach_m,
                               .visit_flats = box_flats,
                               .visit_pieces = box_pieces};

}  // namespace ifov::geometry::units
