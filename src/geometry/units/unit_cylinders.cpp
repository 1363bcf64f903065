#include <algorithm>
#include <cmath>

#include "geometry/units/unit_measures.h"

namespace ifov::geometry::units {
namespace {

using math::Normal3;
using math::Point3;
using math::Transform;
using math::Vec3;

template <bool kCapped>
UnitHit intersect_cylinder(Point3 p, Vec3 d, double t_min, double t_max) {
  UnitHit best;
  const auto offer = [&](double t, std::uint32_t face) {
    if (t > t_min && t < t_max && t < best.t) best = {t, face};
  };
  for (const double t : round_crossings(p, d, false).t) {
    const double z = p.z + t * d.z;
    if (z >= 0.0 && z <= 1.0) offer(t, 0);
  }
  if (kCapped && d.z != 0.0) {
    for (std::uint32_t cap = 0; cap < 2; ++cap) {
      const double t = (double(cap) - p.z) / d.z;
      const double x = p.x + t * d.x, y = p.y + t * d.y;
      if (x * x + y * y <= 1.0) offer(t, 1 + cap);
    }
  }
  return best;
}

Normal3 cylinder_normal(std::uint32_t face, Point3 p) {
  if (face == 0) return math::as_normal(math::normalized({p.x, p.y, 0.0}));
  return {0.0, 0.0, face == 1 ? -1.0 : 1.0};
}

Uv cylinder_uv(std::uint32_t face, Point3 p) {
  if (face == 0) return {turn_of(p), std::clamp(p.z, 0.0, 1.0)};
  return {half_of(p.x), half_of(p.y)};
}

World::Bounds cylinder_bounds(const Transform& object_from_unit) {
  return bounds_by_coordinate(object_from_unit, [](const Extent& e) {
    return std::pair(e.origin + std::min(0.0, e.rise) - e.disc, e.origin + std::max(0.0, e.rise) + e.disc);
  });
}

double cylinder_reach_m(const Transform& object_from_unit, Point3 from_m) {
  return std::max(rim_reach_m(object_from_unit, from_m, 0.0), rim_reach_m(object_from_unit, from_m, 1.0));
}

void cylinder_flats(const UnitFlatVisitor& visitor) {
  for (const double z : {0.0, 1.0})
    visitor({0.0, 0.0, z > 0.5 ? 1.0 : -1.0}, {0.0, 0.0, z}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
}

void open_cylinder_pieces(const Transform& map, const UnitPieceVisitor& visitor) {
  visitor(PieceKind::open_cylinder, 0, map, false);
}

void cylinder_pieces(const Transform& map, const UnitPieceVisitor& visitor) {
  visitor(PieceKind::open_cylinder, 0, map, false);
  const Transform down = Transform::from_columns({0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {});
  visitor(PieceKind::disk, 1, map * down, true);
  visitor(PieceKind::disk, 2, map * Transform::translation({0.0, 0.0, 1.0}), true);
}

}  // namespace

constinit const UnitShape kOpenCylinder{.round_faces = 1,
                                        .intersect = intersect_cylinder<false>,
                                        .normal = cylinder_normal,
                                        .uv = cylinder_uv,
                                        .bounds = cylinder_bounds,
                                        .reach_m = cylinder_reach_m,
                                        .visit_pieces = open_cylinder_pieces,
                                        .known_as_mirror = true};

constinit const UnitShape kCylinder{.faces = 3,
                                    .round_faces = 1,
                                    .intersect = intersect_cylinder<true>,
                                    .normal = cylinder_normal,
                                    .uv = cylinder_uv,
                                    .bounds = cylinder_bounds,
                                    .reach_m = cylinder_reach_m,
                                    .visit_flats = cylinder_flats,
                                    .visit_pieces = cylinder_pieces,
                                    .known_as_mirror = true};

}  // namespace ifov::geometry::units
