// Objects that are there for a time only: rays of that time meet them, others what they would meet if they were not there.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "geometry/height_field.h"
#include "geometry/periodic_world.h"
#include "geometry/presence.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_presence {
namespace {

using math::Ray;
using math::Transform;

constexpr std::uint32_t kVisitor = 1;

Presence visit() { return Presence{{{-100.0, -50.0}, {-10.0, 20.0}}}; }

TEST(Presence, BeginsAndEnds) {
  const Presence presence = visit();
  for (const auto& [time_s, is_there] : {std::pair{-100.1, false},
                                         {-100.0, true},
                                         {-50.1, true},
                                         {-50.0, false},
                                         {-10.0, true},
                                         {0.0, true},
                                         {20.0, false}})
    EXPECT_EQ(presence.at(time_s), is_there) << time_s;
  EXPECT_EQ(presence.nearest(-70.0), -70.0);
  EXPECT_EQ(presence.nearest(-300.0), -100.0);
  EXPECT_EQ(presence.nearest(-20.0), -10.0);
  EXPECT_NEAR(presence.nearest(-45.0), -50.0, 1e-9);
  EXPECT_TRUE(presence.at(presence.nearest(-45.0)));
  EXPECT_FALSE(presence.is_otherwise_within(-9.0, 0.0));
  EXPECT_TRUE(presence.is_otherwise_within(-11.0, 0.0));
  EXPECT_TRUE(presence.is_otherwise_within(-30.0, -20.0));
  EXPECT_FALSE(presence.is_otherwise_within(-90.0, -60.0));
}

TerrainGrid small_terrain() {
  TerrainGrid grid;
  grid.columns = grid.rows = 9;
  grid.corner_m = {-4.0, 4.0, 6.0};
  grid.along_column_m = {1.0, 0.0, 0.0};
  grid.along_row_m = {0.0, -1.0, 0.0};
  for (int k = 0; k < 81; ++k) grid.height_m.push_back(0.3F * static_cast<float>(k % 5));
  return grid;
}

/// Things of every kind. Every second of them comes and goes: `there` whether those are placed, `at_times` whether as visitors.
std::unique_ptr<World> world_of(bool there, bool at_times, InstanceStorage storage, bool periodic) {
  WorldBuilder builder;
  const auto presence = std::make_shared<const Presence>(visit());
  const ShapeId ball = builder.add_shape(test::ball(8, 12, 0.4)), drop = builder.add_shape(Sphere{{}, 0.5}),
                box = builder.add_shape(Box{{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}}),
                plane = builder.add_shape(Plane{1.7}), ground = builder.add_shape(Plane{0.0}),
                field = builder.add_height_field(std::make_shared<HeightField>(small_terrain(), false));
  builder.place(ground, {}, std::vector{0u});
  const auto place = [&](ShapeId what, const Transform& where, bool visitor) {
    if (visitor && !there) return;
    builder.set_presence(visitor && at_times ? presence : nullptr);
    builder.place(what, where, std::vector{visitor ? kVisitor : 0u});
  };
  place(plane, {}, true);
  place(field, {}, true);
  for (std::uint64_t k = 0; k < 40; ++k) {
    const Transform at =
        Transform::translation({8.0 * test::uniform(1, 3 * k) - 4.0, 8.0 * test::uniform(1, 3 * k + 1) - 4.0,
                                0.5 + 4.0 * test::uniform(1, 3 * k + 2)});
    place(k % 3 == 0 ? ball : k % 3 == 1 ? drop : box, at, k % 2 == 0);
  }
  std::unique_ptr<World> world = builder.build({.threads = 1, .instances = storage});
  if (!periodic) return world;
  return std::make_unique<PeriodicWorld>(std::move(world), PeriodicWorld::Cell{-5.0, -5.0, 10.0, 10.0});
}

std::vector<Ray> some_rays(double time_s) {
  std::vector<Ray> rays;
  for (std::uint64_t k = 0; k < 3000; ++k) {
    const math::Point3 to{9.0 * test::uniform(5, 3 * k) - 4.5, 9.0 * test::uniform(5, 3 * k + 1) - 4.5,
                          7.0 * test::uniform(5, 3 * k + 2)};
    const math::Vec3 along = test::direction(6, k);
    // Neighbours in a packet have unlike times.
    rays.push_back(
        {.origin_m = to - 12.0 * along, .direction = along, .time_s = k % 2 == 0 ? time_s : -70.0});
    rays.back().t_max_m = 10.0 + 4.0 * test::uniform(7, k);
  }
  return rays;
}

TEST(Presence, RaysMeetWhatIsThereAtTheirTime) {
  for (const bool periodic : {false, true})
    for (const InstanceStorage storage : {InstanceStorage::nodes, InstanceStorage::table}) {
      const auto coming = world_of(true, true, storage, periodic),
                 with = world_of(true, false, storage, periodic),
                 without = world_of(false, false, storage, periodic);
      EXPECT_EQ(coming->presences().size(), 1u);
      EXPECT_TRUE(with->presences().empty());
      EXPECT_EQ(coming->presence(0), nullptr);
      EXPECT_NE(coming->presence(1), nullptr);
      for (const double time_s : {-200.0, -100.0, -30.0, 0.0, 30.0}) {
        const std::vector<Ray> rays = some_rays(time_s);
        std::vector<SurfacePoint> hits(rays.size()), expected(rays.size());
        std::vector<std::uint8_t> blocked(rays.size()), expected_blocked(rays.size());
        coming->intersect(rays, hits);
        coming->occluded(rays, blocked);
        int differ = 0, visitors = 0;
        for (std::size_t k = 0; k < rays.size(); ++k) {
          const World& like = visit().at(rays[k].time_s) ? *with : *without;
          const World& other = visit().at(rays[k].time_s) ? *without : *with;
          SurfacePoint hit, otherwise;
          std::uint8_t is_blocked = 0;
          like.intersect({&rays[k], 1}, {&hit, 1});
          like.occluded({&rays[k], 1}, {&is_blocked, 1});
          other.intersect({&rays[k], 1}, {&otherwise, 1});
          ASSERT_EQ(hits[k].hit(), hit.hit()) << k << " at " << time_s;
          ASSERT_EQ(blocked[k], is_blocked) << k << " at " << time_s;
          differ += hit.hit() != otherwise.hit() || (hit.hit() && hit.material != otherwise.material);
          if (!hit.hit()) continue;
          ASSERT_EQ(hits[k].material, hit.material) << k;
          ASSERT_NEAR(hits[k].distance_m, hit.distance_m, 1e-6) << k;
          visitors += hit.material == kVisitor;
        }
        EXPECT_GT(differ, 500);  // to look at the wrong time would show
        EXPECT_GT(visitors, 200);
      }
    }
}

}  // namespace
}  // namespace ifov::geometry::test_presence
