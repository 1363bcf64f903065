#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/units/unit_measures.h"

namespace ifov::geometry::units {
namespace {

using math::Normal3;
using math::Point3;
using math::Transform;
using math::Vec3;

template <bool kWhole>
UnitHit intersect_ball(Point3 p, Vec3 d, double t_min, double t_max) {
  for (const double t : round_crossings(p, d, true).t)
    if (t > t_min && t < t_max && (kWhole || p.z + t * d.z >= 0.0)) return {t, 0};
  return {};
}

Normal3 ball_normal(std::uint32_t, Point3 p) { return math::as_normal(math::normalized({p.x, p.y, p.z})); }

Uv sphere_uv(std::uint32_t, Point3 p) {
  return {turn_of(p), 0.5 + std::asin(std::clamp(p.z, -1.0, 1.0)) / std::numbers::pi};
}

Uv hemisphere_uv(std::uint32_t, Point3 p) {
  return {turn_of(p), 2.0 * std::asin(std::clamp(p.z, 0.0, 1.0)) / std::numbers::pi};
}

World::Bounds sphere_bounds(const Transform& object_from_unit) {
  return bounds_by_coordinate(object_from_unit, [](const Extent& e) {
    const double ball = std::hypot(e.disc, e.rise);
    return std::pair(e.origin - ball, e.origin + ball);
  });
}

World::Bounds hemisphere_bounds(const Transform& object_from_unit) {
  return bounds_by_coordinate(object_from_unit, [](const Extent& e) {
    const double ball = std::hypot(e.disc, e.rise);
    return std::pair(e.origin - (e.rise < 0.0 ? ball : e.disc), e.origin + (e.rise > 0.0 ? ball : e.disc));
  });
}

template <PieceKind kKind>
void ball_pieces(const Transform& map, const UnitPieceVisitor& visitor) {
  visitor(kKind, 0, map, false);
}

}  // namespace

constinit const UnitShape kSphere{.round_faces = 1,
                                  .intersect = intersect_ball<true>,
                                  .normal = ball_normal,
                                  .uv = sphere_uv,
                                  .bounds = sphere_bounds,
                                  .reach_m = ball_reach_m,
                                  .visit_pieces = ball_pieces<PieceKind::ball>,
                                  .known_as_mirror = true};

constinit const UnitShape kHemisphere{.round_faces = 1,
                                      .intersect = intersect_ball<false>,
                                      .normal = ball_normal,
                                      .uv = hemisphere_uv,
                                      .bounds = hemisphere_bounds,
                                      .reach_m = ball_reach_m,
                                      .visit_pieces = ball_pieces<PieceKind::hemisphere>,
                                      .centred = true,
                                      .known_as_mirror = true};

}  // namespace ifov::geometry::units
