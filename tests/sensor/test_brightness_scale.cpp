#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "radiometry/channel.h"
#include "sensor/detector/brightness_scale.h"

namespace ifov::sensor::test_brightness_scale {
namespace {

using radiometry::Channel;

/// Largest departure from the temperature of the blackbody that sends the radiance times a factor; not 1: a planted fault.
double most_off_k(const Channel& channel, double factor) {
  const BrightnessScale scale(channel);
  double most = 0.0;
  for (double kelvin = 60.0; kelvin < 4000.0; kelvin *= 1.0137)
    most = std::max(
        most,
        std::abs(scale.kelvin(factor * radiometry::channel_planck_w_m2_sr_um(channel, kelvin)) - kelvin));
  return most;
}

TEST(BrightnessScale, IsTheInverseOfTheChannelsRadiance) {
  for (const Channel& channel : {Channel::monochromatic("a", 10.0), Channel::gaussian("b", 10.9, 0.6),
                                 Channel::top_hat("c", 3.6, 4.9), Channel::gaussian("d", 0.65, 0.04)}) {
    EXPECT_LT(most_off_k(channel, 1.0), 1e-4) << channel.name;
    EXPECT_GT(most_off_k(channel, 1.001), 1e-2) << channel.name;
  }
}

TEST(BrightnessScale, GoesOnBeyondItsTable) {
  const Channel channel = Channel::gaussian("a", 10.9, 0.6);
  const BrightnessScale scale(channel);
  for (const double kelvin : {30.0, 6500.0})
    EXPECT_NEAR(scale.kelvin(radiometry::channel_planck_w_m2_sr_um(channel, kelvin)), kelvin, 1e-6 * kelvin);
  EXPECT_TRUE(std::isnan(scale.kelvin(0.0)));
  EXPECT_TRUE(std::isnan(scale.kelvin(-1.0)));
}

}  // namespace
}  // namespace ifov::sensor::test_brightness_scale
