// Rays that start on surfaces: none meets the surface it leaves, none leaks through a closed one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "geometry/world/world_builder.h"
#include "math/frame.h"
#include "scene_maker.h"

namespace ifov::geometry::test_world_secondary {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;

const std::array<std::uint32_t, 1> kOne{0};

/// Secondary rays from where rays from `from` towards `target` (spread over `spread_m`) met something.
std::vector<Ray> secondary_rays(const World& world, Point3 from, Point3 target, double spread_m,
                                std::size_t count) {
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i)
    rays.push_back(
        {from, normalized(target + test::direction(30, i) * (spread_m * test::uniform(31, i)) - from)});
  std::vector<SurfacePoint> hits(count);
  world.intersect(rays, hits);
  std::vector<Ray> leaving;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!hits[i].hit()) continue;
    const math::Normal3 side = hits[i].front ? hits[i].geometric_normal : -hits[i].geometric_normal;
    const Vec3 n = side.as_vector();
    // Uniform over the hemisphere, down to the horizon.
    Vec3 local = test::direction(32, i);
    local.z = std::abs(local.z);
    leaving.push_back(
        {hits[i].position_m + n * hits[i].offset_m, math::frame_from_normal(side).outer_from_local(local)});
  }
  return leaving;
}

std::size_t blocked_of(const World& world, const std::vector<Ray>& rays) {
  std::vector<std::uint8_t> blocked(rays.size());
  world.occluded(rays, blocked);
  std::vector<SurfacePoint> hits(rays.size());
  world.intersect(rays, hits);
  std::size_t count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    count += blocked[i];
    EXPECT_EQ(blocked[i] != 0, hits[i].hit());
  }
  return count;
}

/// `shape`, closed and convex, about the origin of its frame, placed about `at` in a scene that reaches 8 km.
struct Case {
  const char* name;
  Shape shape;
  bool instanced;
};
std::vector<Case> closed_cases() {
  return {{"sphere", Sphere{{}, 3.0}, false},
          {"box", Box{{-2, -2, -2}, {2, 2, 2}}, false},
          {"cylinder", Cylinder{{0, 0, -2}, 2.0, 4.0, true}, false},
          {"ball of triangles", test::ball(24, 40, 3.0), false},
          {"ball of triangles as an instance", test::ball(24, 40, 3.0), true}};
}
std::unique_ptr<World> world_of(const Case& c, Point3 at) {
  WorldBuilder builder;
  const ShapeId id = builder.add_shape(c.shape);
  const Transform turn = Transform::rotation({1, 2, 3}, 0.8) * Transform::scaling({1.2, 1.2, 1.2});
  builder.place(id, Transform::translation(at - Point3{}) * turn, kOne);
  if (c.instanced)
    builder.place(id, Transform::translation({-8000, -8000, 0}), kOne);
  else
    builder.place(builder.add_shape(Sphere{{-8000, -8000, 0}, 1.0}), {}, kOne);
  return builder.build(1);
}

TEST(WorldSecondary, OutsideAConvexBodyNothingIsMet) {
  for (const Case& c : closed_cases()) {
    SCOPED_TRACE(c.name);
    for (const Point3 at : {Point3{8000, 8000, 10}, Point3{-7990, -7990, 0}}) {
      const auto world = world_of(c, at);
      std::size_t rays = 0, met = 0;
      for (int side = 0; side < 4; ++side) {
        const Point3 from = at + test::direction(33, static_cast<std::uint64_t>(side)) * 3000.0;
        const auto leaving = secondary_rays(*world, from, at, 3.5, 20000);
        rays += leaving.size();
        // The other body of the scene may be met, 22 km or some metres away: leave those rays out.
        std::vector<Ray> short_ones = leaving;
        for (Ray& ray : short_ones) ray.t_max_m = 5.0;
        met += blocked_of(*world, short_ones);
      }
      EXPECT_GT(rays, 40000u);
      EXPECT_EQ(met, 0u);
    }
  }
}

TEST(WorldSecondary, InsideAClosedBodyNoneEscapes) {
  for (const Case& c : closed_cases()) {
    SCOPED_TRACE(c.name);
    const Point3 at{8000, 8000, 10};
    const auto world = world_of(c, at);
    std::vector<Ray> leaving;
    for (int k = 0; k < 4; ++k) {
      const Point3 from = at + test::direction(34, static_cast<std::uint64_t>(k)) * 0.5;
      const auto some = secondary_rays(*world, from, from + Vec3{0, 0, 1e-3}, 1.0, 20000);
      EXPECT_EQ(some.size(), 20000u);
      leaving.insert(leaving.end(), some.begin(), some.end());
    }
    for (Ray& ray : leaving) ray.t_max_m = 100.0;
    EXPECT_EQ(blocked_of(*world, leaving), leaving.size());
  }
}

/// A spiky closed body, 8 km from the middle of a scene where a float step is half a millimetre. A ray that
/// leaves it close to the bottom of a sharp hollow may start behind the neighbouring facet and see the inner
/// side of the body: rarely, and four times as often were the offset four times as large.
TEST(WorldSecondary, HollowsDoNotLeak) {
  TriangleMesh rough = test::ball(40, 60, 30.0);
  for (std::size_t k = 0; k < rough.vertices_m.size(); ++k)
    rough.vertices_m[k] = Point3{} + (rough.vertices_m[k] - Point3{}) * (0.8 + 0.2 * test::uniform(35, k));
  for (const bool instanced : {false, true}) {
    const Point3 at{8000, 8000, 10};
    const auto world = world_of({"rough ball", rough, instanced}, at);
    std::size_t inner = 0, rays = 0, met = 0;
    for (std::uint64_t side = 0; side < 6; ++side) {
      const auto leaving = secondary_rays(*world, at + test::direction(39, side) * 3000.0, at, 40.0, 50000);
      std::vector<SurfacePoint> hits(leaving.size());
      world->intersect(leaving, hits);
      rays += leaving.size();
      for (const SurfacePoint& hit : hits) {
        if (!hit.hit() || hit.distance_m > 200.0) continue;
        ++met;
        inner += !hit.front;
      }
    }
    EXPECT_GT(met, rays / 20);
    EXPECT_LT(double(inner), 1.5e-4 * double(rays));
    RecordProperty(instanced ? "inner_instanced" : "inner_copied", static_cast<int>(inner));
    RecordProperty("rays", static_cast<int>(rays));
  }
}

TEST(WorldSecondary, ABoxOnAPlaneKeepsItsLight) {
  WorldBuilder builder;
  builder.place(builder.add_shape(Plane{}), {}, kOne);
  builder.place(builder.add_shape(Box{{-50, -50, 0}, {50, 50, 30}}), {}, kOne);
  const auto world = builder.build(1);
  const auto leaving = secondary_rays(*world, {3, 4, 10}, {3, 4, 9.9}, 0.2, 50000);
  EXPECT_EQ(leaving.size(), 50000u);
  EXPECT_EQ(blocked_of(*world, leaving), leaving.size());
}

TEST(WorldSecondary, PlaneIsLeftFreely) {
  WorldBuilder builder;
  builder.place(builder.add_shape(Plane{123.456}), {}, kOne);
  const auto world = builder.build(1);
  const auto leaving = secondary_rays(*world, {1e5, -2e5, 700e3}, {0, 0, 0}, 1e5, 50000);
  EXPECT_EQ(leaving.size(), 50000u);
  EXPECT_EQ(blocked_of(*world, leaving), 0u);
}

/// Rays aimed exactly at vertices and at points of edges of a surface that is wider than the rays' spread.
TEST(WorldSecondary, SharedVerticesAndEdgesDoNotLeak) {
  for (const bool instanced : {false, true}) {
    const TriangleMesh ground = test::height_field(64, {8000, 5600, 100});
    WorldBuilder builder;
    const ShapeId id = builder.add_shape(ground);
    builder.place(id, {}, kOne);
    if (instanced)
      builder.place(id, Transform::translation({-16000, -11200, 0}), kOne);
    else
      builder.place(builder.add_shape(Sphere{{-8000, -5600, 0}, 1.0}), {}, kOne);
    const auto world = builder.build(1);
    std::vector<Ray> rays;
    for (std::uint64_t i = 0; i < 40000; ++i) {
      const auto x = static_cast<std::uint32_t>(8 + 48 * test::uniform(36, 2 * i)),
                 y = static_cast<std::uint32_t>(8 + 48 * test::uniform(36, 2 * i + 1));
      const Point3 a = ground.vertices_m[y * 65 + x], b = ground.vertices_m[(y + 1) * 65 + x + 1];
      const Point3 target = a + (b - a) * (i % 2 ? test::uniform(37, i) : 0.0);
      const Vec3 d = normalized(test::direction(38, i) * 0.4 + Vec3{0, 0, -1});
      rays.push_back({target - d * 50.0, d});
    }
    EXPECT_EQ(blocked_of(*world, rays), rays.size());
  }
}

}  // namespace
}  // namespace ifov::geometry::test_world_secondary
