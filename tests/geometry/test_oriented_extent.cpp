#include <gtest/gtest.h>

#include <vector>

#include "geometry/oriented_extent.h"
#include "geometry/world/world_builder.h"
#include "math/transform.h"

namespace ifov::geometry::test_oriented_extent {
namespace {

World::Bounds bounds_of(const std::vector<math::Point3>& points) {
  World::Bounds b{points[0], points[0]};
  for (const math::Point3& p : points) {
    b.low_m = {std::min(b.low_m.x, p.x), std::min(b.low_m.y, p.y), std::min(b.low_m.z, p.z)};
    b.high_m = {std::max(b.high_m.x, p.x), std::max(b.high_m.y, p.y), std::max(b.high_m.z, p.z)};
  }
  return b;
}

TEST(OrientedExtent, ShowsHowThinATurnedRodIs) {
  const math::Transform turned = math::Transform::rotation({0.0, 0.0, 1.0}, 0.6);
  std::vector<math::Point3> rod;
  for (const double x : {-0.75, 0.75})
    for (const double y : {-0.015, 0.015}) rod.push_back(turned(math::Point3{x, y, 0.1}));
  const HalfSides sides = oriented_extent(rod, bounds_of(rod));
  EXPECT_NEAR(length(sides[0]), 0.75, 0.01);
  EXPECT_LT(length(sides[1]), 0.04);
  EXPECT_NEAR(std::abs(sides[0].y / sides[0].x), std::tan(0.6), 0.05);
}

TEST(OrientedExtent, KeepsTheAxesOfASquareThatStandsAlongThem) {
  const std::vector<math::Point3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const HalfSides sides = oriented_extent(square, bounds_of(square));
  EXPECT_NEAR(length(sides[0]), 0.5, 1e-12);
  EXPECT_NEAR(length(sides[1]), 0.5, 1e-12);
}

TEST(World, ObjectsTellTheirLengthAndWidth) {
  WorldBuilder builder;
  const ShapeId box = builder.add_shape(Box{{-1.0, -0.02, 0.0}, {1.0, 0.02, 0.05}});
  const std::uint32_t material[] = {0};
  builder.place(box, math::Transform::rotation({0.0, 0.0, 1.0}, 1.0), material);
  const auto world = builder.build(1);
  EXPECT_NEAR(length(world->object(0).half_sides_m[0]), 1.0, 1e-12);
  EXPECT_NEAR(2.0 * length(world->object(0).half_sides_m[1]), 0.05, 1e-12);
  EXPECT_NEAR(world->object(0).half_sides_m[0].x, std::cos(1.0), 1e-12);
}

}  // namespace
}  // namespace ifov::geometry::test_oriented_extent
