#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "truth/location.h"

namespace ifov::truth::test_location {
namespace {

TEST(Location, IsWhereTheRayMeetsTheSceneAndNoNumberElsewhere) {
  const scene::Scene scene;
  const std::vector<math::Ray> rays(2);
  std::vector<geometry::SurfacePoint> hits(2);
  hits[1].material = 0;
  hits[1].position_m = {1.0, 2.0, 5e5 + 1.0 / 1024};
  ASSERT_FALSE(hits[0].hit());
  ASSERT_TRUE(hits[1].hit());
  std::vector<double> values(6);
  std::get<Collector::Collect<double>>(kLocation.collect)({scene, rays, hits}, values);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isnan(values[static_cast<std::size_t>(k)]));
  EXPECT_EQ(values[3], 1.0);
  EXPECT_EQ(values[4], 2.0);
  EXPECT_EQ(values[5], 5e5 + 1.0 / 1024);
  std::vector<double> truth(6);
  std::get<Collector::Collect<double>>(kTrueLocation.collect)({scene, rays, hits}, truth);
  EXPECT_EQ(truth[5], values[5]) << "a sensor whose pose is known";
}

}  // namespace
}  // namespace ifov::truth::test_location
