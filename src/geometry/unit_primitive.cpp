#include "geometry/unit_primitive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::geometry {
namespace {

using math::Normal3;
using math::Point3;
using math::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The two crossings of a line with a unit circle or sphere in the span of the given components, from the
/// point of closest approach: the textbook discriminant loses all digits when the start is far away.
struct Crossings {
  double t[2] = {kInfinity, kInfinity};
};
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

UnitHit intersect_cylinder(Point3 p, Vec3 d, double t_min, double t_max, bool capped) {
  UnitHit best;
  const auto offer = [&](double t, std::uint32_t face) {
    if (t > t_min && t < t_max && t < best.t) best = {t, face};
  };
  for (const double t : round_crossings(p, d, false).t) {
    const double z = p.z + t * d.z;
    if (z >= 0.0 && z <= 1.0) offer(t, 0);
  }
  if (capped && d.z != 0.0) {
    for (std::uint32_t cap = 0; cap < 2; ++cap) {
      const double t = (double(cap) - p.z) / d.z;
      const double x = p.x + t * d.x, y = p.y + t * d.y;
      if (x * x + y * y <= 1.0) offer(t, 1 + cap);
    }
  }
  return best;
}

/// A map by components: x[i] is component i of the image of the unit vector x.
struct Rows {
  double x[3], y[3], z[3], origin[3];
};
Rows rows_of(const math::Transform& m) {
  const Vec3 x = m.column_x(), y = m.column_y(), z = m.column_z();
  const Point3 o = m.origin_m();
  return {{x.x, x.y, x.z}, {y.x, y.y, y.z}, {z.x, z.y, z.z}, {o.x, o.y, o.z}};
}

}  // namespace

UnitHit intersect_unit(UnitKind kind, Point3 p, Vec3 d, double t_min, double t_max) {
  switch (kind) {
    case UnitKind::box: return intersect_box(p, d, t_min, t_max);
    case UnitKind::sphere:
    case UnitKind::hemisphere:
      for (const double t : round_crossings(p, d, true).t)
        if (t > t_min && t < t_max && (kind == UnitKind::sphere || p.z + t * d.z >= 0.0)) return {t, 0};
      return {};
    case UnitKind::open_cylinder:
    case UnitKind::cylinder: return intersect_cylinder(p, d, t_min, t_max, kind == UnitKind::cylinder);
    case UnitKind::disk: {
      if (d.z == 0.0) return {};
      const double t = -p.z / d.z;
      const double x = p.x + t * d.x, y = p.y + t * d.y;
      if (t > t_min && t < t_max && x * x + y * y <= 1.0) return {t, 0};
      return {};
    }
  }
  return {};
}

Normal3 unit_normal(UnitKind kind, std::uint32_t face, Point3 p) {
  switch (kind) {
    case UnitKind::box: {
      const double side = face % 2 == 0 ? -1.0 : 1.0;
      return {face / 2 == 0 ? side : 0.0, face / 2 == 1 ? side : 0.0, face / 2 == 2 ? side : 0.0};
    }
    case UnitKind::sphere:
    case UnitKind::hemisphere: return math::as_normal(math::normalized({p.x, p.y, p.z}));
    case UnitKind::open_cylinder:
    case UnitKind::cylinder:
      if (face == 0) return math::as_normal(math::normalized({p.x, p.y, 0.0}));
      return {0.0, 0.0, face == 1 ? -1.0 : 1.0};
    case UnitKind::disk: return {0.0, 0.0, 1.0};
  }
  return {0.0, 0.0, 1.0};
}

Uv unit_uv(UnitKind kind, std::uint32_t face, Point3 p) {
  const auto turn = [&] {
    const double a = std::atan2(p.y, p.x) / (2.0 * std::numbers::pi);
    return a < 0.0 ? a + 1.0 : a;
  };
  const auto half = [](double x) { return std::clamp(0.5 * (x + 1.0), 0.0, 1.0); };
  switch (kind) {
    case UnitKind::box: return {half(face / 2 == 0 ? p.y : p.x), half(face / 2 == 2 ? p.y : p.z)};
    case UnitKind::sphere: return {turn(), 0.5 + std::asin(std::clamp(p.z, -1.0, 1.0)) / std::numbers::pi};
    case UnitKind::hemisphere: return {turn(), 2.0 * std::asin(std::clamp(p.z, 0.0, 1.0)) / std::numbers::pi};
    case UnitKind::open_cylinder:
    case UnitKind::cylinder:
      if (face == 0) return {turn(), std::clamp(p.z, 0.0, 1.0)};
      return {half(p.x), half(p.y)};
    case UnitKind::disk: return {half(p.x), half(p.y)};
  }
  return {};
}

std::uint32_t unit_face_count(UnitKind kind) {
  return kind == UnitKind::box ? 6 : kind == UnitKind::cylinder ? 3 : 1;
}

World::Bounds unit_bounds(UnitKind kind, const math::Transform& object_from_unit) {
  const Rows m = rows_of(object_from_unit);
  double low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    const double o = m.origin[i], disc = std::hypot(m.x[i], m.y[i]), rise = m.z[i];
    const double ball = std::hypot(disc, rise);
    switch (kind) {
      case UnitKind::box: {
        const double reach = std::abs(m.x[i]) + std::abs(m.y[i]) + std::abs(m.z[i]);
        low[i] = o - reach, high[i] = o + reach;
        break;
      }
      case UnitKind::sphere: low[i] = o - ball, high[i] = o + ball; break;
      case UnitKind::hemisphere:
        low[i] = o - (rise < 0.0 ? ball : disc), high[i] = o + (rise > 0.0 ? ball : disc);
        break;
      case UnitKind::open_cylinder:
      case UnitKind::cylinder:
        low[i] = o + std::min(0.0, rise) - disc, high[i] = o + std::max(0.0, rise) + disc;
        break;
      case UnitKind::disk: low[i] = o - disc, high[i] = o + disc; break;
    }
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

double unit_reach_m(UnitKind kind, const math::Transform& object_from_unit, Point3 from_m) {
  const Vec3 x = object_from_unit.column_x(), y = object_from_unit.column_y(),
             z = object_from_unit.column_z();
  const Vec3 w = object_from_unit.origin_m() - from_m;
  // |w + M e|^2 <= |w|^2 + 2 |M^T w| + |M|^2 for unit vectors e: exact where w is orthogonal or M a
  // similarity.
  const auto ball = [&] {
    const double stretch = largest_stretch(object_from_unit);
    return std::sqrt(dot(w, w) + 2.0 * math::length({dot(x, w), dot(y, w), dot(z, w)}) + stretch * stretch);
  };
  const auto rim = [&](Vec3 v) {
    const double stretch2 = std::max(dot(x, x), dot(y, y)) + std::abs(dot(x, y));
    return std::sqrt(dot(v, v) + 2.0 * std::hypot(dot(x, v), dot(y, v)) + stretch2);
  };
  switch (kind) {
    case UnitKind::box: {
      double reach = 0.0;
      for (int corner = 0; corner < 8; ++corner)
        reach = std::max(reach, length(w + x * (corner & 1 ? 1.0 : -1.0) + y * (corner & 2 ? 1.0 : -1.0) +
                                       z * (corner & 4 ? 1.0 : -1.0)));
      return reach;
    }
    case UnitKind::sphere:
    case UnitKind::hemisphere: return ball();
    case UnitKind::open_cylinder:
    case UnitKind::cylinder: return std::max(rim(w), rim(w + z));
    case UnitKind::disk: return rim(w);
  }
  return kInfinity;
}

double largest_stretch(const math::Transform& map) {
  const Vec3 x = map.column_x(), y = map.column_y(), z = map.column_z();
  const double xy = std::abs(dot(x, y)), xz = std::abs(dot(x, z)), yz = std::abs(dot(y, z));
  return std::sqrt(std::max({dot(x, x) + xy + xz, dot(y, y) + xy + yz, dot(z, z) + xz + yz}));
}

}  // namespace ifov::geometry
