#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/unit_primitive.h"
#include "scene_maker.h"

namespace ifov::geometry::test_unit_primitive {
namespace {

using math::Point3;
using math::Transform;
using math::Vec3;

constexpr UnitKind kKinds[] = {UnitKind::box,           UnitKind::sphere,   UnitKind::hemisphere,
                               UnitKind::open_cylinder, UnitKind::cylinder, UnitKind::disk};

/// How far a point lies off the surface of the kind, as its implicit equation says.
double off_surface(UnitKind kind, Point3 p) {
  const double r = std::hypot(p.x, p.y);
  if (kind == UnitKind::box) return std::abs(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 1.0);
  if (kind == UnitKind::sphere) return std::abs(std::hypot(r, p.z) - 1.0);
  if (kind == UnitKind::hemisphere) return std::max(std::abs(std::hypot(r, p.z) - 1.0), -p.z);
  if (kind == UnitKind::open_cylinder) return std::max({std::abs(r - 1.0), -p.z, p.z - 1.0});
  if (kind == UnitKind::cylinder)
    return std::min(std::max({std::abs(r - 1.0), -p.z, p.z - 1.0}),
                    std::max(std::min(std::abs(p.z), std::abs(p.z - 1.0)), r - 1.0));
  if (kind == UnitKind::disk) return std::max(std::abs(p.z), r - 1.0);
  return 1.0;
}

TEST(UnitPrimitive, HitsLieOnTheSurfaceAndInsideTheBounds) {
  for (const UnitKind kind : kKinds) {
    const Transform map = Transform::translation({5, 6, 7}) * Transform::rotation({1, 2, 3}, 0.9) *
                          Transform::scaling({2, 0.5, 3});
    const World::Bounds bounds = unit_bounds(kind, map);
    const Point3 from{4, 4, 4};
    const double reach = unit_reach_m(kind, map, from);
    Point3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    int hits = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const Vec3 d = test::direction(60, i);
      const Point3 p = Point3{} + test::direction(61, i) * 1.2 - d * 10.0;
      const UnitHit hit = intersect_unit(kind, p, d, 0.0, 1e9);
      if (!std::isfinite(hit.t)) continue;
      ++hits;
      const Point3 q = p + d * hit.t;
      EXPECT_LT(off_surface(kind, q), 1e-12);
      EXPECT_LT(hit.face, unit_face_count(kind));
      EXPECT_NEAR(length(unit_normal(kind, hit.face, q).as_vector()), 1.0, 1e-14);
      const Uv uv = unit_uv(kind, hit.face, q);
      EXPECT_TRUE(uv.u >= 0 && uv.u <= 1 && uv.v >= 0 && uv.v <= 1);
      const Point3 placed = map(q);
      EXPECT_LT(length(placed - from), reach + 1e-9);
      low = {std::min(low.x, placed.x), std::min(low.y, placed.y), std::min(low.z, placed.z)};
      high = {std::max(high.x, placed.x), std::max(high.y, placed.y), std::max(high.z, placed.z)};
      // The next hit along the line lies on the surface too, farther on.
      const UnitHit next = intersect_unit(kind, p, d, hit.t + 1e-9, 1e9);
      if (std::isfinite(next.t)) {
        EXPECT_LT(off_surface(kind, p + d * next.t), 1e-12);
      }
      EXPECT_FALSE(std::isfinite(intersect_unit(kind, p, d, 0.0, hit.t).t));
    }
    EXPECT_GT(hits, 1000);
    const Vec3 below = low - bounds.low_m, above = bounds.high_m - high;
    for (const double gap : {below.x, below.y, below.z, above.x, above.y, above.z}) {
      EXPECT_GE(gap, -1e-9);
      EXPECT_LT(gap, 1.2);  // no looser than the shape's own box
    }
  }
}

TEST(UnitPrimitive, ReachOfABallIsItsRadius) {
  const Transform map =
      Transform::translation({1, 2, 3}) * Transform::rotation({3, 2, 1}, 0.5) * Transform::scaling({4, 4, 4});
  EXPECT_NEAR(unit_reach_m(UnitKind::sphere, map, {1, 2, 3}), 4.0, 1e-12);
  EXPECT_NEAR(unit_reach_m(UnitKind::sphere, map, {1, 2, 13}), 14.0, 1e-12);
  EXPECT_NEAR(unit_reach_m(UnitKind::disk, map, {1, 2, 3}), 4.0, 1e-12);
  EXPECT_NEAR(largest_stretch(map), 4.0, 1e-12);
}

}  // namespace
}  // namespace ifov::geometry::test_unit_primitive
