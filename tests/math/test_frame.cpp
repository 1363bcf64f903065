#include <gtest/gtest.h>

#include <cmath>

#include "math/frame.h"

namespace ifov::math::test_frame {
namespace {

TEST(Frame, IsOrthonormalAndRightHandedEverywhere) {
  for (int i = 0; i < 1000; ++i) {
    const double z =
        i < 10 ? (i % 2 ? -1.0 : 1.0) * (1.0 - std::pow(10.0, -i)) : -1.0 + 2.0 * (i + 0.5) / 1000.0;
    const double a = 2.399963 * i, r = std::sqrt(1.0 - z * z);
    const Normal3 n{r * std::cos(a), r * std::sin(a), z};
    const Frame f = frame_from_normal(n);
    EXPECT_EQ(f.z, n.as_vector());
    EXPECT_NEAR(length(f.x), 1.0, 1e-14);
    EXPECT_NEAR(length(f.y), 1.0, 1e-14);
    EXPECT_NEAR(dot(f.x, f.y), 0.0, 1e-14);
    EXPECT_NEAR(dot(f.x, f.z), 0.0, 1e-14);
    EXPECT_NEAR(dot(cross(f.x, f.y), f.z), 1.0, 1e-14);
    const Vec3 v{0.3, -0.4, 0.5}, back = f.local_from_outer(f.outer_from_local(v));
    EXPECT_NEAR(length(back - v), 0.0, 1e-14);
  }
}

TEST(Frame, DebugBuildsRefuseANormalOfAnotherLength) {
  EXPECT_DEBUG_DEATH(frame_from_normal({0, 0, 2}), "1e-6");
}

TEST(Frame, PolesAreNoExceptions) {
  EXPECT_EQ(frame_from_normal({0, 0, 1}).x, (Vec3{1, 0, 0}));
  const Frame down = frame_from_normal({0, 0, -1});
  EXPECT_NEAR(dot(cross(down.x, down.y), down.z), 1.0, 0.0);
}

}  // namespace
}  // namespace ifov::math::test_frame
