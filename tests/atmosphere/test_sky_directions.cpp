#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::atmosphere::test_sky_directions {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(SkyDirections, WeightsIntegrateWhatIsLinearBetweenThem) {
  const SkyDirections sky = SkyDirections::standard(33.0 * kDegree);
  const std::vector<double> weights = sky.level_weights();
  ASSERT_EQ(weights.size(), sky.zenith_rad.size() * sky.azimuth_rad.size());
  EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), std::numbers::pi, 1e-6);
  // Zenith angle itself: 2 pi int z cos z sin z dz = pi^2 / 4.
  double sum = 0.0;
  for (std::size_t d = 0; d < weights.size(); ++d)
    sum += weights[d] * sky.zenith_rad[d / sky.azimuth_rad.size()];
  EXPECT_NEAR(sum, std::numbers::pi * std::numbers::pi / 4.0, 1e-4);
  // Azimuth, of which both sides of the Sun's plane count: its mean is pi / 2.
  sum = 0.0;
  for (std::size_t d = 0; d < weights.size(); ++d)
    sum += weights[d] * sky.azimuth_rad[d % sky.azimuth_rad.size()];
  EXPECT_NEAR(sum, 0.5 * std::numbers::pi * std::numbers::pi, 1e-5);
}

TEST(SkyDirections, AreCloserAroundTheSun) {
  for (const double sun : {0.0, 33.0, 60.0, 88.0}) {
    const SkyDirections sky = SkyDirections::standard(sun * kDegree);
    EXPECT_TRUE(std::is_sorted(sky.zenith_rad.begin(), sky.zenith_rad.end()));
    EXPECT_EQ(sky.zenith_rad.front(), 0.0);
    const auto near = std::count_if(sky.zenith_rad.begin(), sky.zenith_rad.end(),
                                    [&](double z) { return std::abs(z - sun * kDegree) < 6.5 * kDegree; });
    EXPECT_GE(near, 3) << sun;
    for (std::size_t k = 0; k + 1 < sky.zenith_rad.size(); ++k)
      EXPECT_GE(sky.zenith_rad[k + 1] - sky.zenith_rad[k], 1.4 * kDegree);
  }
}

// What the renderer samples is, integrated, the irradiance that the solver found, in every node.
TEST(SensorAtmosphere, SkyTableHoldsTheIrradiance) {
  const std::vector<radiometry::Channel> channels = {radiometry::Channel::gaussian("", 0.45, 0.02),
                                                     radiometry::Channel::gaussian("", 0.94, 0.02),
                                                     radiometry::Channel::gaussian("", 10.0, 0.5)};
  SensorAtmosphere::Inputs inputs;
  inputs.channels = channels;
  inputs.solar_irradiance = radiometry::solar_irradiance_1au();
  inputs.demands.tolerance = 3e-3;
  inputs.demands.most_nodes = 8;
  inputs.geometry.sun_zenith_rad = 50.0 * kDegree;
  const SensorAtmosphere air(AtmosphereColumn{AtmosphereDescription{}}, inputs);
  const SkyDirections& sky = air.sky_directions();
  const std::vector<double> weights = sky.level_weights();
  const std::size_t azimuths = sky.azimuth_rad.size();
  for (std::size_t n = 0; n < air.node_count(); ++n) {
    double sum = 0.0, groundlit = 0.0;
    for (std::size_t d = 0; d < weights.size(); ++d) {
      sum += weights[d] * air.sky(d / azimuths, d % azimuths, n);
      groundlit += weights[d] * air.groundlit_sky(d / azimuths, n);
    }
    EXPECT_NEAR(sum / air.sky_irradiance()[n], 1.0, 1e-6);
    EXPECT_NEAR(groundlit, std::numbers::pi * air.spherical_albedo()[n], 1e-9);
    EXPECT_GT(air.sky_irradiance()[n], 0.0);
  }
  // Bright around the Sun, brighter at the horizon than in the zenith, in the blue.
  const auto at = [&](double zenith) {
    return static_cast<std::size_t>(
        std::min_element(sky.zenith_rad.begin(), sky.zenith_rad.end(),
                         [&](double a, double b) { return std::abs(a - zenith) < std::abs(b - zenith); }) -
        sky.zenith_rad.begin());
  };
  EXPECT_GT(air.sky(at(50.0 * kDegree), 0, 0), 3.0 * air.sky(at(50.0 * kDegree), azimuths - 1, 0));
  EXPECT_GT(air.sky(at(80.0 * kDegree), azimuths - 1, 0), air.sky(0, azimuths - 1, 0));
}

}  // namespace
}  // namespace ifov::atmosphere::test_sky_directions
