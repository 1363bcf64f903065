#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/scene.h"

namespace ifov::scene::test_sun {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Sun, SaysWhereItStands) {
  Sun sun;
  for (const double zenith_deg : {0.001, 30.0, 89.9, 90.0, 100.0, 179.0})
    for (const double azimuth_deg : {-179.0, -90.0, 0.0, 45.0, 180.0}) {
      const double zenith = zenith_deg * kDegree, azimuth = azimuth_deg * kDegree;
      sun.direction = {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
                       std::cos(zenith)};
      EXPECT_NEAR(sun.zenith_rad(), zenith, 1e-14);
      EXPECT_NEAR(sun.elevation_rad(), 0.5 * std::numbers::pi - zenith, 1e-14);
      EXPECT_NEAR(sun.azimuth_rad(), azimuth, 1e-11) << zenith_deg;
      if (zenith_deg != 90.0) {
        EXPECT_EQ(sun.is_up(), zenith_deg < 90.0);
      }
    }
  sun.direction = {1.0, 0.0, 0.0};
  EXPECT_FALSE(sun.is_up()) << "on the horizon it lights nothing level";
}

}  // namespace
}  // namespace ifov::scene::test_sun
