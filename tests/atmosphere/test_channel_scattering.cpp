#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/sensor/channel_scattering.h"
#include "atmosphere/sensor/directions/sky_directions.h"

namespace ifov::atmosphere::test_channel_scattering {
namespace {

/// Where a channel across the edge of a water band is checked, under a Sun of this irradiance.
std::vector<ChannelScattering::WeakPoint> weak_points(double irradiance) {
  const AtmosphereColumn column{AtmosphereDescription{}};
  SensorGeometry geometry;
  geometry.sun_zenith_rad = 0.8;
  const std::vector<std::vector<ChannelBin>> bins{
      channel_bins(radiometry::Channel::top_hat("", 0.90, 0.95), radiometry::Spectrum::constant(irradiance))};
  const BinOptics optics(column, bins, 1);
  const ChannelPoints points(column, bins.front(), optics, geometry);
  const SkyDirections directions{{0.0, 1.0}, {0.0, std::numbers::pi}};
  return ChannelScattering(column, points, geometry, directions, {}).weak_points();
}

// What a point stands for is a share of the light, whatever the Sun's strength.
TEST(ChannelScattering, SharesOfWeakPointsDoNotDependOnTheSun) {
  const auto bright = weak_points(1000.0), dim = weak_points(1e-3);
  ASSERT_EQ(bright.size(), 2u);
  ASSERT_EQ(dim.size(), 2u);
  EXPECT_NEAR(bright[0].share + bright[1].share, 1.0, 1e-12);
  EXPECT_GT(std::abs(bright[0].share - bright[1].share), 0.02);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(bright[k].point, dim[k].point);
    EXPECT_NEAR(bright[k].share, dim[k].share, 1e-9);
  }
}

}  // namespace
}  // namespace ifov::atmosphere::test_channel_scattering
