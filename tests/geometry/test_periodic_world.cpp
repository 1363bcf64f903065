#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.h"
#include "geometry/periodic_world.h"
#include "geometry/world/world_builder.h"
#include "sampling/random.h"

namespace ifov::geometry::test_periodic_world {
namespace {

constexpr double kWidth = 10.0, kHeight = 7.0;
const PeriodicWorld::Cell kCell{-5.0, -3.5, kWidth, kHeight};

/// A ball across the eastern border, a box at the southern one, a disk; a plane if asked for.
void place_cell(WorldBuilder& builder, const math::Transform& moved, std::uint32_t first_material) {
  const auto place = [&](const Shape& shape, std::uint32_t material) {
    const std::vector<std::uint32_t> materials{first_material + material};
    builder.place(builder.add_shape(shape), moved, materials);
  };
  place(Sphere{{4.6, 1.0, 1.2}, 1.0}, 0);
  place(Box{{-2.0, -4.3, 0.0}, {-0.5, -3.0, 2.0}}, 1);
  place(Disk{{1.0, 1.0, 3.0}, 0.6}, 2);
}

/// The ray's hit among `rings` copies on each side, laid out one by one.
std::unique_ptr<World> laid_out(int rings, bool with_plane) {
  WorldBuilder builder;
  for (int i = -rings; i <= rings; ++i)
    for (int j = -rings; j <= rings; ++j)
      place_cell(builder, math::Transform::translation({i * kWidth, j * kHeight, 0.0}), 0);
  if (with_plane) {
    const std::vector<std::uint32_t> material{3};
    builder.place(builder.add_shape(Plane{}), {}, material);
  }
  return builder.build(1);
}

std::unique_ptr<World> repeated(bool with_plane, PeriodicWorld::Cell cell = kCell) {
  WorldBuilder builder;
  place_cell(builder, {}, 0);
  if (with_plane) {
    const std::vector<std::uint32_t> material{3};
    builder.place(builder.add_shape(Plane{}), {}, material);
  }
  return std::make_unique<PeriodicWorld>(builder.build(1), cell);
}

std::vector<math::Ray> some_rays(std::size_t count) {
  const auto random = [](std::size_t k, int n) { return sampling::unit_double(sampling::hash(k, n)); };
  std::vector<math::Ray> rays;
  for (std::size_t k = 0; k < count; ++k) {
    const double z = 2.0 * random(k, 0) - 1.0, turn = 6.2831853 * random(k, 1), r = std::sqrt(1.0 - z * z);
    rays.push_back({{40.0 * random(k, 2) - 20.0, 40.0 * random(k, 3) - 20.0, 0.1 + 6.0 * random(k, 4)},
                    {r * std::cos(turn), r * std::sin(turn), z}});
  }
  return rays;
}

TEST(PeriodicWorld, IsTheUnionOfItsCopies) {
  const std::unique_ptr<World> copies = laid_out(6, true), periodic = repeated(true);
  const std::vector<math::Ray> rays = some_rays(4000);
  std::vector<SurfacePoint> expected(rays.size()), hits(rays.size());
  copies->intersect(rays, expected);
  periodic->intersect(rays, hits);
  std::size_t compared = 0, across = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (!expected[k].hit() || expected[k].distance_m > 20.0) continue;  // the copies end somewhere
    ++compared;
    across += hits[k].copy_column != 0;
    ASSERT_TRUE(hits[k].hit());
    EXPECT_NEAR(hits[k].distance_m, expected[k].distance_m, 1e-9);
    EXPECT_NEAR(math::length(hits[k].position_m - expected[k].position_m), 0.0, 1e-9);
    EXPECT_EQ(hits[k].material, expected[k].material);
    EXPECT_EQ(hits[k].front, expected[k].front);
  }
  EXPECT_GT(compared, 1500u);
  EXPECT_GT(across, 500u);
}

TEST(PeriodicWorld, ShadowsAreThoseOfTheCopies) {
  const std::unique_ptr<World> copies = laid_out(6, false), periodic = repeated(false);
  std::vector<math::Ray> rays = some_rays(4000);
  for (math::Ray& ray : rays) ray.t_max_m = 15.0;
  std::vector<std::uint8_t> expected(rays.size()), blocked(rays.size());
  copies->occluded(rays, expected);
  periodic->occluded(rays, blocked);
  EXPECT_EQ(expected, blocked);
  EXPECT_GT(std::count(blocked.begin(), blocked.end(), std::uint8_t{1}), 300);
}

TEST(PeriodicWorld, DoesNotDependOnWhereTheCellBegins) {
  const std::unique_ptr<World> one = repeated(true), other = repeated(true, {3.3, 11.1, kWidth, kHeight});
  const std::vector<math::Ray> rays = some_rays(2000);
  std::vector<SurfacePoint> a(rays.size()), b(rays.size());
  one->intersect(rays, a);
  other->intersect(rays, b);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    ASSERT_EQ(a[k].hit(), b[k].hit());
    if (!a[k].hit()) continue;
    EXPECT_EQ(a[k].instance, b[k].instance);
    EXPECT_NEAR(a[k].distance_m, b[k].distance_m, 1e-9 * (1.0 + a[k].distance_m));
  }
}

TEST(PeriodicWorld, LevelRaysMeetSomethingOrLeave) {
  const std::unique_ptr<World> periodic = repeated(false);
  const std::vector<math::Ray> rays{{{-22.0, 8.0, 1.2}, {1.0, 0.0, 0.0}},
                                    {{0.0, -1.5, 2.5}, {1.0, 0.0, 0.0}},
                                    {{0.0, 0.0, 50.0}, {1.0, 0.0, 0.0}}};
  std::vector<SurfacePoint> hits(rays.size());
  periodic->intersect(rays, hits);
  ASSERT_TRUE(hits[0].hit());
  EXPECT_NEAR(hits[0].distance_m, 22.0 - 15.4 - 1.0, 1e-9);
  EXPECT_EQ(hits[0].copy_column, -2);
  EXPECT_EQ(hits[0].copy_row, 1);
  EXPECT_FALSE(hits[1].hit());
  EXPECT_FALSE(hits[2].hit());
}

TEST(PeriodicWorld, RefusesWhatCannotRepeat) {
  const auto message = [](PeriodicWorld::Cell cell) -> std::string {
    try {
      repeated(false, cell);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message({0.0, 0.0, -1.0, 1.0}), "a scene repeats every -1 m x 1 m; expected positive lengths");
  EXPECT_EQ(
      message({0.0, 0.0, 0.5, 0.5}),
      "a scene that repeats every 0.5 m x 0.5 m holds something that reaches more than 8 times as far beyond "
      "that cell (x -2 to 5.6 m, y -4.3 to 2 m)");
}

}  // namespace
}  // namespace ifov::geometry::test_periodic_world
