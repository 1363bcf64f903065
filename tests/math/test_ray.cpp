#include <gtest/gtest.h>

#include <limits>

#include "math/ray.h"

namespace ifov::math::test_ray {
namespace {

TEST(Ray, GoesOnAtTheSameTimeWithoutItsLimits) {
  const Ray ray{{1.0, 2.0, 3.0}, {0.0, 0.0, -1.0}, 0.5, 9.0, 7.25};
  const Ray next = ray.onward({4.0, 5.0, 6.0}, {1.0, 0.0, 0.0});
  EXPECT_EQ(next.origin_m, (Point3{4.0, 5.0, 6.0}));
  EXPECT_EQ(next.direction, (Vec3{1.0, 0.0, 0.0}));
  EXPECT_EQ(next.t_min_m, 0.0);
  EXPECT_EQ(next.t_max_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(next.time_s, 7.25);
  EXPECT_EQ(Ray{}.time_s, 0.0);
}

}  // namespace
}  // namespace ifov::math::test_ray
