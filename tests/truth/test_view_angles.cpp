#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "truth/view_angles.h"

namespace ifov::truth::test_view_angles {
namespace {

// Of the ray itself: whatever camera sent it, from wherever that stood.
TEST(ViewAngles, AreThoseOfTheDirectionBackAlongTheRay) {
  const scene::Scene scene;
  const double half = std::sqrt(0.5);
  std::vector<math::Ray> rays(4);
  rays[0].direction = {0.0, 0.0, -1.0};
  rays[1].direction = {0.0, half, -half};   // from the south
  rays[2].direction = {half, 0.0, -half};   // from the west
  rays[3].direction = {-half, 0.0, -half};  // from the east, past everything
  std::vector<geometry::SurfacePoint> hits(4);
  for (int k = 0; k < 3; ++k) hits[static_cast<std::size_t>(k)].material = 0;
  std::vector<float> values(8);
  std::get<Collector::Collect<float>>(kViewAngles.collect)({scene, rays, hits}, values);
  EXPECT_EQ(values[0], 0.0f);
  EXPECT_EQ(values[2], 45.0f);
  EXPECT_EQ(values[3], 180.0f);
  EXPECT_EQ(values[4], 45.0f);
  EXPECT_EQ(values[5], 270.0f);
  EXPECT_TRUE(std::isnan(values[6]));
  EXPECT_TRUE(std::isnan(values[7]));
}

}  // namespace
}  // namespace ifov::truth::test_view_angles
