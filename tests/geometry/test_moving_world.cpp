#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/motion/motion.h"
#include "geometry/motion/moving_world.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_moving_world {
namespace {

using math::Point3;
using math::Vec3;
using test::direction;
using test::uniform;

constexpr double kFrom_s = -0.5, kTo_s = 1.5;

/// Up a helix, turning about an axis that is none of the scene's.
class Helix final : public Motion {
 public:
  math::Transform scene_from_carrier(double t) const override {
    return math::Transform::translation({6.0 * std::cos(2.0 * t), 6.0 * std::sin(2.0 * t), 3.0 + t}) *
           math::Transform::rotation({0.3, 0.2, 1.0}, 2.5 * t);
  }
  double step_s() const override { return 0.2; }
};

/// What moves, about its own origin: a box and a ball of triangles beside it.
void place_mover(WorldBuilder& builder, const math::Transform& placed) {
  const std::vector<std::uint32_t> box{1}, ball{2};
  builder.place(builder.add_shape(Box{{-1.0, -2.0, -0.5}, {1.0, 2.0, 0.5}}), placed, box);
  builder.place(builder.add_shape(test::ball(12, 16, 0.8, {1.5, 0.0, 0.4})), placed, ball);
}

void place_first(WorldBuilder& builder) {
  const std::vector<std::uint32_t> material{0};
  builder.place(builder.add_shape(Plane{}), {}, material);
}

void place_last(WorldBuilder& builder) {
  const std::vector<std::uint32_t> material{3};
  builder.place(builder.add_shape(Sphere{{0.0, 0.0, 2.0}, 1.5}), {}, material);
}

std::unique_ptr<MovingWorld> moving() {
  WorldBuilder still, body;
  place_first(still);
  std::vector<MovingWorld::Mover> movers(1);
  movers[0].after = still.object_count();
  place_last(still);
  place_mover(body, {});
  movers[0].body = body.build(1);
  movers[0].motion = std::make_shared<const Helix>();
  return std::make_unique<MovingWorld>(still.build(1), std::move(movers), kFrom_s, kTo_s);
}

/// The same scene as it stands at an instant, built as if nothing moved.
std::unique_ptr<World> stopped(double time_s) {
  WorldBuilder builder;
  place_first(builder);
  place_mover(builder, Helix().scene_from_carrier(time_s));
  place_last(builder);
  return builder.build(1);
}

std::vector<math::Ray> some_rays(std::size_t count, std::uint64_t key, double time_s) {
  std::vector<math::Ray> rays;
  for (std::uint64_t k = 0; k < count; ++k)
    rays.push_back({.origin_m = {24.0 * uniform(key, 5 * k) - 12.0, 24.0 * uniform(key, 5 * k + 1) - 12.0,
                                 0.1 + 9.0 * uniform(key, 5 * k + 2)},
                    .direction = direction(key + 1, k),
                    .time_s = time_s});
  return rays;
}

/// Rays of times within and beyond those that are told of, in the same batch, against worlds that were built for each.
TEST(MovingWorld, AnswersAsAWorldThatStandsAtTheRaysTime) {
  const auto world = moving();
  ASSERT_EQ(world->object_count(), 4u);
  std::vector<math::Ray> all;
  std::vector<SurfacePoint> expected;
  std::vector<std::uint8_t> expected_blocked;
  for (const double time_s : {-0.9, -0.5, 0.0, 0.3, 0.77, 1.5, 2.0}) {
    const auto rays = some_rays(6000, 17, time_s);
    const auto still = stopped(time_s);
    std::vector<SurfacePoint> hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    still->intersect(rays, hits);
    still->occluded(rays, blocked);
    all.insert(all.end(), rays.begin(), rays.end());
    expected.insert(expected.end(), hits.begin(), hits.end());
    expected_blocked.insert(expected_blocked.end(), blocked.begin(), blocked.end());
  }
  std::vector<SurfacePoint> hits(all.size());
  std::vector<std::uint8_t> blocked(all.size());
  world->intersect(all, hits);
  world->occluded(all, blocked);
  std::size_t met = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    ASSERT_EQ(hits[k].hit(), expected[k].hit()) << k;
    EXPECT_EQ(blocked[k], expected_blocked[k]) << k;
    if (!hits[k].hit()) continue;
    EXPECT_EQ(hits[k].instance, expected[k].instance) << k;
    EXPECT_EQ(hits[k].material, expected[k].material) << k;
    EXPECT_EQ(hits[k].front, expected[k].front) << k;
    EXPECT_LT(math::length(hits[k].position_m - expected[k].position_m), 1e-9) << k;
    EXPECT_NEAR(hits[k].distance_m, expected[k].distance_m, 1e-9) << k;
    EXPECT_GT(math::dot(hits[k].geometric_normal.as_vector(), expected[k].geometric_normal.as_vector()),
              1.0 - 1e-9)
        << k;
    met += world->is_moving(hits[k].instance);
  }
  EXPECT_GT(met, 500u);
}

TEST(MovingWorld, BoundsAndHeightsHoldAllOfTheWay) {
  const auto world = moving();
  const World::Bounds bounds = world->bounds();
  for (double t = kFrom_s; t <= kTo_s; t += 0.013) {
    const Point3 at = Helix().scene_from_carrier(t)(Point3{1.0, 2.0, 0.5});
    EXPECT_TRUE(at.x >= bounds.low_m.x && at.x <= bounds.high_m.x && at.y >= bounds.low_m.y &&
                at.y <= bounds.high_m.y && at.z <= bounds.high_m.z && at.z <= world->heights().high_m);
  }
  EXPECT_LT(world->heights().high_m, 8.0);
}

/// How many rays that meet the mover, of so many at random times, are said not to within a time about theirs; and how many of all are
/// said to.
struct Told {
  std::size_t met = 0, missed = 0, said = 0, all = 0;
};
template <class Says>
Told told(const Says& says) {
  const auto world = moving();
  Told told;
  for (int k = 0; k < 400; ++k) {
    const double time_s = kFrom_s + (kTo_s - kFrom_s) * uniform(5, static_cast<std::uint64_t>(k));
    const auto rays = some_rays(250, 100 + static_cast<std::uint64_t>(k), time_s);
    std::vector<SurfacePoint> hits(rays.size());
    world->intersect(rays, hits);
    for (std::size_t j = 0; j < rays.size(); ++j) {
      math::Ray ray = rays[j];
      if (hits[j].hit()) ray.t_max_m = hits[j].distance_m;
      const bool said = says(*world, ray, time_s), met = hits[j].hit() && world->is_moving(hits[j].instance);
      told.all += 1, told.said += said, told.met += met, told.missed += met && !said;
    }
  }
  return told;
}

TEST(MovingWorld, NothingIsMetWhereItIsSaidThatNothingMoves) {
  const Told found = told([](const MovingWorld& world, const math::Ray& ray, double time_s) {
    return world.may_move_into(ray, std::max(kFrom_s, time_s - 0.01), std::min(kTo_s, time_s + 0.01), 0.0);
  });
  EXPECT_GT(found.met, 1000u);
  EXPECT_EQ(found.missed, 0u);
  // The boxes hold little but what moves.
  EXPECT_LT(found.said, 3 * found.met);
}

TEST(MovingWorld, AWrongTimeIsNoticed) {
  const Told found = told([](const MovingWorld& world, const math::Ray& ray, double time_s) {
    const double other_s = time_s < 0.5 ? time_s + 0.2 : time_s - 0.2;
    return world.may_move_into(ray, other_s, other_s, 0.0);
  });
  EXPECT_GT(found.missed, found.met / 20);
}

}  // namespace
}  // namespace ifov::geometry::test_moving_world
