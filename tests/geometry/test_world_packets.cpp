// The answer to a ray does not depend on its neighbours in the batch.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_world_packets {
namespace {

using math::Ray;
using math::Transform;
using math::Vec3;

bool equal(const SurfacePoint& a, const SurfacePoint& b) {
  return a.position_m == b.position_m && a.geometric_normal == b.geometric_normal &&
         a.shading_normal == b.shading_normal && a.distance_m == b.distance_m && a.u == b.u && a.v == b.v &&
         a.instance == b.instance && a.patch == b.patch && a.material == b.material &&
         a.primitive == b.primitive && a.front == b.front && a.offset_m == b.offset_m;
}

/// Ground twice over (every facet exactly doubled), balls that pierce each other and the ground, boxes, a
/// plane below.
std::unique_ptr<World> crowded_world() {
  WorldBuilder builder;
  const std::array<std::uint32_t, 1> one{0};
  TriangleMesh ground = test::height_field(100, {});
  const std::size_t n = ground.triangles.size();
  for (std::size_t k = 0; k < n; k += 2) ground.triangles.push_back(ground.triangles[k]);
  const ShapeId field = builder.add_shape(ground), ball = builder.add_shape(test::ball(12, 20, 1.5));
  const ShapeId box = builder.add_shape(Box{{-1, -1, -1}, {1, 1, 1}}),
                sphere = builder.add_shape(Sphere{{}, 1.0});
  builder.place(field, {}, one);
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Vec3 at{90 * test::uniform(40, 3 * i) - 45, 90 * test::uniform(40, 3 * i + 1) - 45,
                  3 * test::uniform(40, 3 * i + 2)};
    const Transform map = Transform::translation(at) * Transform::rotation(test::direction(41, i), 1.0);
    builder.place(ball, map, one);
    if (i % 3 == 0) builder.place(ball, map, one);  // two in one place
    if (i % 4 == 0) builder.place(box, map, one);
    if (i % 5 == 0) builder.place(sphere, map, one);
  }
  builder.place(builder.add_shape(Plane{-1.0}), {}, one);
  return builder.build(1);
}

TEST(WorldPackets, OrderAndCompanyDoNotShow) {
  const auto world = crowded_world();
  const TriangleMesh ground = test::height_field(100, {});
  constexpr std::size_t kRays = 60000;
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < kRays; ++i) {
    const Vec3 d = normalized(test::direction(42, i) + Vec3{0, 0, -0.8});
    math::Point3 target{90 * test::uniform(43, 2 * i) - 45, 90 * test::uniform(43, 2 * i + 1) - 45, 0.5};
    // A third is aimed at vertices, where many triangles are equally near.
    if (i % 3 == 0)
      target =
          ground
              .vertices_m[static_cast<std::size_t>(test::uniform(44, i) * double(ground.vertices_m.size()))];
    rays.push_back({target - d * (i % 2 ? 60.0 : 4.0), d});
  }
  std::vector<SurfacePoint> hits(kRays);
  std::vector<std::uint8_t> blocked(kRays);
  world->intersect(rays, hits);
  world->occluded(rays, blocked);
  std::size_t met = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    ASSERT_EQ(hits[i].hit(), blocked[i] != 0) << i;
    met += blocked[i];
  }
  EXPECT_GT(met, kRays / 2);

  for (std::uint64_t round = 0; round < 3; ++round) {
    std::vector<std::size_t> order(kRays);
    for (std::size_t i = 0; i < kRays; ++i) order[i] = i;
    for (std::size_t i = kRays - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(test::uniform(45 + round, i) * double(i + 1))]);
    std::vector<Ray> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rays[i]);
    std::vector<SurfacePoint> other_hits(kRays);
    std::vector<std::uint8_t> other_blocked(kRays);
    world->intersect(shuffled, other_hits);
    world->occluded(shuffled, other_blocked);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < kRays; ++i)
      differ += !equal(hits[order[i]], other_hits[i]) || blocked[order[i]] != other_blocked[i];
    EXPECT_EQ(differ, 0u);
  }

  std::size_t differ = 0;
  for (std::size_t i = 0; i < kRays; i += 3) {
    SurfacePoint alone;
    world->intersect({&rays[i], 1}, {&alone, 1});
    differ += !equal(alone, hits[i]);
  }
  EXPECT_EQ(differ, 0u);
}

/// Of balls in one place the first placed is met, whatever its neighbours.
TEST(WorldPackets, TwinsGoToTheLast) {
  WorldBuilder builder;
  const std::array<std::uint32_t, 1> one{0};
  const ShapeId ball = builder.add_shape(test::ball(10, 16, 2.0)),
                disk = builder.add_shape(Disk{{0, 0, 5}, 1.0});
  for (int copy = 0; copy < 5; ++copy) builder.place(ball, {}, one);
  for (int copy = 0; copy < 5; ++copy) builder.place(disk, {}, one);
  const auto world = builder.build(1);
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < 4000; ++i)
    rays.push_back({math::Point3{} - test::direction(47, i) * 50.0 + test::direction(48, i) * 1.5,
                    test::direction(47, i)});
  std::vector<SurfacePoint> hits(rays.size());
  world->intersect(rays, hits);
  for (const SurfacePoint& hit : hits) {
    if (!hit.hit()) continue;
    EXPECT_TRUE(hit.instance == 4 || hit.instance == 9) << hit.instance;
  }
}

}  // namespace
}  // namespace ifov::geometry::test_world_packets
