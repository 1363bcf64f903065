#include "geometry/units/unit_measures.h"

namespace ifov::geometry::units {
namespace {

using math::Normal3;
using math::Point3;
using math::Transform;
using math::Vec3;

UnitHit intersect_disk(Point3 p, Vec3 d, double t_min, double t_max) {
  if (d.z == 0.0) return {};
  const double t = -p.z / d.z;
  const double x = p.x + t * d.x, y = p.y + t * d.y;
  if (t > t_min && t < t_max && x * x + y * y <= 1.0) return {t, 0};
  return {};
}

World::Bounds disk_bounds(const Transform& object_from_unit) {
  return bounds_by_coordinate(
      object_from_unit, [](const Extent& e) { return std::pair(e.origin - e.disc, e.origin + e.disc); });
}

double disk_reach_m(const Transform& object_from_unit, Point3 from_m) {
  return rim_reach_m(object_from_unit, from_m, 0.0);
}

void disk_flats(const UnitFlatVisitor& visitor) {
  visitor({0.0, 0.0, 1.0}, {}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
}

void disk_pieces(const Transform& map, const UnitPieceVisitor& visitor) {
  visitor(PieceKind::disk, 0, map, false);
}

}  // namespace

constinit const UnitShape kDisk{.intersect = intersect_disk,
                                .normal =
                                    [](std::uint32_t, Point3) {
                                      return Normal3{0.0, 0.0, 1.0};
                                    },
                                .uv =
                                    [](std::uint32_t, Point3 p) {
                                      return Uv{half_of(p.x), half_of(p.y)};
                                    },
                                .bounds = disk_bounds,
                                .reach_m = disk_reach_m,
                                .visit_flats = disk_flats,
                                .visit_pieces = disk_pieces};

}  // namespace ifov::geometry::units
