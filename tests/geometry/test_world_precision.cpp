// Far from the origin and from far away: positions against double brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/format.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_world_precision {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;

const std::array<std::uint32_t, 1> kOne{0};
constexpr double kTolerance_m = 1e-4;

/// Two patches of ground 16 km apart, so that one lies 8 km from the middle of the scene; the scene itself
/// stands at `origin`. `instanced`: the patch is one of two copies of a prototype.
void expect_exact(Point3 origin, double range_m, bool instanced) {
  const Point3 at = origin + Vec3{8000.0, 5000.0, 100.0};
  TriangleMesh patch = test::height_field(48, {});
  WorldBuilder builder;
  std::vector<Point3> placed;
  if (instanced) {
    const Transform map = Transform::translation(at - Point3{}) * Transform::rotation({0.1, 0.2, 1.0}, 0.7) *
                          Transform::scaling({1.1, 1.1, 1.1});
    const ShapeId id = builder.add_shape(patch);
    builder.place(id, map, kOne);
    builder.place(id, Transform::translation(origin - Vec3{8000, 5000, 0} - Point3{}), kOne);
    for (const Point3& p : patch.vertices_m) placed.push_back(map(p));
  } else {
    const TriangleMesh near = test::height_field(48, at),
                       far = test::height_field(8, origin - Vec3{8000, 5000, 0});
    builder.place(builder.add_shape(near), {}, kOne);
    builder.place(builder.add_shape(far), {}, kOne);
    placed = near.vertices_m;
  }
  const auto world = builder.build(1);

  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const Point3 target =
        at + Vec3{30 * test::uniform(20, 2 * i) - 15, 30 * test::uniform(20, 2 * i + 1) - 15, 1.0};
    const double off = std::tan(0.5 * test::uniform(21, 2 * i)),
                 a = 6.283185307179586 * test::uniform(21, 2 * i + 1);
    const Point3 from = target + Vec3{off * std::cos(a), off * std::sin(a), 1.0} * range_m;
    rays.push_back({from, normalized(target - from)});
  }
  std::vector<SurfacePoint> hits(rays.size());
  world->intersect(rays, hits);
  double worst = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const test::BruteHit truth = test::brute_force(placed, patch.triangles, rays[i]);
    ASSERT_TRUE(std::isfinite(truth.t));
    ASSERT_TRUE(hits[i].hit());
    // At an edge within Embree's rounding its neighbour may be met: the position is then as near as the edge.
    if (truth.margin < 1e-2) continue;
    EXPECT_EQ(hits[i].primitive, truth.triangle);
    worst = std::max(worst, length(hits[i].position_m - (rays[i].origin_m + rays[i].direction * truth.t)));
  }
  EXPECT_LT(worst, kTolerance_m);
  testing::Test::RecordProperty("worst_m", format("{:.2e}", worst));
}

TEST(WorldPrecision, EightKilometresFromTheMiddle) { expect_exact({}, 3000.0, false); }
TEST(WorldPrecision, FromOrbit) { expect_exact({}, 700e3, false); }
TEST(WorldPrecision, SceneAtFiveHundredKilometres) { expect_exact({500e3, -300e3, 200.0}, 3000.0, false); }
TEST(WorldPrecision, SceneAtFiveHundredKilometresFromOrbit) {
  expect_exact({500e3, 400e3, 0.0}, 700e3, false);
}
TEST(WorldPrecision, InstancesEightKilometresFromTheMiddle) { expect_exact({}, 3000.0, true); }
TEST(WorldPrecision, InstancesAtFiveHundredKilometresFromOrbit) {
  expect_exact({500e3, -300e3, 0.0}, 700e3, true);
}

/// Analytic shapes do not know Embree's rounding at all.
TEST(WorldPrecision, SphereAtFiveHundredKilometres) {
  const Point3 centre{500e3, 400e3, 10.0};
  WorldBuilder builder;
  const ShapeId id = builder.add_shape(Sphere{{}, 1.0});
  builder.place(id, Transform::translation(centre - Point3{}), kOne);
  builder.place(id, Transform::translation(centre + Vec3{8000, 0, 0} - Point3{}), kOne);
  const auto world = builder.build(1);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Vec3 d = test::direction(22, i), aside = cross(d, test::direction(23, i)) * 0.99;
    const Ray ray{centre - d * 700e3 + aside, d};
    SurfacePoint hit;
    world->intersect({&ray, 1}, {&hit, 1});
    ASSERT_TRUE(hit.hit());
    EXPECT_NEAR(length(hit.position_m - centre), 1.0, 1e-8);
  }
}

/// The rim of a disk 8 km from the middle of the scene is where it should be, to a micrometre.
TEST(WorldPrecision, RimsAreExact) {
  WorldBuilder builder;
  const ShapeId disk = builder.add_shape(Disk{{}, 2.0});
  builder.place(disk, Transform::translation({8000, 8000, 0}), kOne);
  builder.place(disk, Transform::translation({-8000, -8000, 0}), kOne);
  const auto world = builder.build(1);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double a = 6.283185307179586 * test::uniform(24, i), r = i % 2 ? 2.0 - 1e-6 : 2.0 + 1e-6;
    const Ray ray{{8000 + r * std::cos(a), 8000 + r * std::sin(a), 500.0}, {0, 0, -1}};
    std::uint8_t blocked = 2;
    world->occluded({&ray, 1}, {&blocked, 1});
    EXPECT_EQ(blocked, i % 2);
  }
}

}  // namespace
}  // namespace ifov::geometry::test_world_precision
