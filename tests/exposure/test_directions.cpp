// Directions from tilted surfaces to above and below the horizon.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "exposure/exposed_point.h"
#include "exposure/past_scene.h"
#include "geometry/surface_point.h"
#include "geometry/world.h"
#include "geometry/world/world_builder.h"
#include "sampling/random.h"
#include "sampling/warp.h"

namespace ifov::exposure::test_directions {
namespace {

const std::vector<std::uint32_t> kOne{0};

/// Sums of directions and of their squares along an axis.
struct Sum {
  double count = 0.0, mean = 0.0, square = 0.0;
  void add(double value) {
    ++count;
    mean += value;
    square += value * value;
  }
  double of() const { return mean / count; }
  double error() const { return std::sqrt(std::max(0.0, square / count - of() * of()) / count); }
};

TEST(Directions, AreThoseOfAHemisphereByCosinesThatLieAboveTheHorizonOrBelow) {
  constexpr int kPairs = 4, kDraws = 3000, kTries = 400000;
  geometry::WorldBuilder builder;
  builder.place(builder.add_shape(geometry::Plane{}), {}, kOne);
  const auto world = builder.build(1);
  const PastScene scene(*world);
  for (const double tilt_deg : {3.0, 40.0, 90.0, 150.0}) {
    const double tilt_rad = tilt_deg * std::numbers::pi / 180.0, azimuth_rad = 0.8;
    geometry::SurfacePoint point;
    point.geometric_normal = point.shading_normal =
        math::as_normal({std::sin(tilt_rad) * std::sin(azimuth_rad),
                         std::sin(tilt_rad) * std::cos(azimuth_rad), std::cos(tilt_rad)});
    point.position_m = {0.0, 0.0, 1.0};
    point.front = true;
    const ExposedPoint exposed(scene, point);
    // Of all directions by their cosines those that are wanted, as they come.
    std::array<std::array<Sum, 3>, 2> expected;
    const sampling::TangentFrame frame(exposed.normal());
    for (int k = 0; k < kTries; ++k) {
      const math::Vec3 one = frame.to_world(
          sampling::cosine_hemisphere({sampling::unit_double(sampling::hash(std::uint64_t{5}, k, 0)),
                                       sampling::unit_double(sampling::hash(std::uint64_t{5}, k, 1))}));
      auto& of = expected[one.z > 0.0 ? 1 : 0];
      of[0].add(one.x), of[1].add(one.y), of[2].add(one.z);
    }
    for (const bool up : {false, true}) {
      std::array<Sum, 3> found;
      std::vector<math::Vec3> directions;
      for (int draw = 0; draw < kDraws; ++draw) {
        const auto key = static_cast<std::uint64_t>(draw);
        if (up)
          exposed.sky_directions(key, kPairs, directions);
        else
          exposed.ground_directions(key, kPairs, directions);
        // A gentle slope sees little below the horizon, and is told of it all the same.
        ASSERT_EQ(directions.size(), 2u * kPairs) << tilt_deg << " " << up;
        for (const math::Vec3 one : directions) {
          EXPECT_EQ(one.z > 0.0, up);
          EXPECT_NEAR(math::length(one), 1.0, 1e-12);
          EXPECT_GE(math::dot(one, exposed.normal()), 0.0);
          found[0].add(one.x), found[1].add(one.y), found[2].add(one.z);
        }
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Sum& other = expected[up ? 1 : 0][axis];
        if (other.count < 100.0) continue;
        EXPECT_NEAR(found[axis].of(), other.of(), 4.0 * std::hypot(found[axis].error(), other.error()))
            << tilt_deg << " " << up << " " << axis;
      }
    }
  }
}

}  // namespace
}  // namespace ifov::exposure::test_directions
