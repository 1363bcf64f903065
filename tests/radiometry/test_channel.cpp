#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "radiometry/channel.h"
#include "radiometry/planck.h"

namespace ifov::radiometry::test_channel {
namespace {

TEST(Channel, GaussianHasItsCentreAndWidth) {
  const Channel c = Channel::gaussian("b", 0.55, 0.010);
  const Channel again = Channel::tabulated("b", c.response);
  EXPECT_NEAR(again.centre_um, 0.55, 1e-12);
  EXPECT_NEAR(again.fwhm_um, 0.010, 1e-6);
  // Integral of a Gaussian: sigma sqrt(2 pi), less what the cut at 4 sigma takes (6.3e-5).
  const double sigma = 0.010 / 2.3548200450309493;
  EXPECT_NEAR(integral(c.response, 0.5, 0.6) / (sigma * std::sqrt(2.0 * 3.14159265358979)), 1.0, 1e-4);
}

TEST(Channel, TabulatedMoments) {
  // A triangle: centroid at the mean of its corners, full width half of its base.
  const Channel c = Channel::tabulated("t", Spectrum({1.0, 1.2, 1.6}, {0.0, 2.0, 0.0}));
  EXPECT_NEAR(c.centre_um, (1.0 + 1.2 + 1.6) / 3.0, 1e-12);
  EXPECT_NEAR(c.fwhm_um, 0.3, 1e-12);
  const Channel noisy =
      Channel::tabulated("n", Spectrum({1.0, 1.2, 1.6, 1.7, 1.8}, {0.0, 2.0, 0.0, -0.5, 0.0}));
  EXPECT_NEAR(noisy.centre_um, c.centre_um, 1e-12);
}

TEST(Channel, TopHatMeans) {
  const Channel c = Channel::top_hat("h", 0.4, 0.6);
  const Spectrum ramp({0.3, 0.9}, {0.3, 0.9});
  EXPECT_NEAR(channel_mean(c, ramp), 0.5, 1e-14);
  EXPECT_DOUBLE_EQ(c.centre_um, 0.5);
  EXPECT_NEAR(c.fwhm_um, 0.2, 1e-14);
}

TEST(Channel, MonochromaticIsExact) {
  const Channel c = Channel::monochromatic("m", 8.5);
  EXPECT_DOUBLE_EQ(channel_planck_w_m2_sr_um(c, 313.15), planck_w_m2_sr_um(8.5, 313.15));
  EXPECT_DOUBLE_EQ(channel_mean(c, Spectrum({8.0, 9.0}, {0.0, 1.0})), 0.5);
}

TEST(Channel, BrightnessTemperatureInverts) {
  for (const Channel& c : {Channel::top_hat("wide", 3.0, 14.0), Channel::gaussian("lwir", 10.9, 0.6),
                           Channel::monochromatic("m", 8.5), Channel::gaussian("swir", 2.2, 0.01)})
    for (const double t : {200.0, 287.3, 300.0, 950.0})
      EXPECT_NEAR(channel_brightness_temperature_k(c, channel_planck_w_m2_sr_um(c, t)), t, 1e-8) << c.name;
  EXPECT_EQ(channel_brightness_temperature_k(Channel::gaussian("lwir", 10.9, 0.6), -1.0), 0.0);
}

TEST(Channel, RefusesImpossibleShapes) {
  EXPECT_THROW(Channel::gaussian("g", 0.5, 0.0), InputError);
  EXPECT_THROW(Channel::gaussian("g", 0.5, 0.6), InputError);
  EXPECT_THROW(Channel::top_hat("h", 0.6, 0.4), InputError);
  EXPECT_THROW(Channel::monochromatic("m", 0.0), InputError);
  EXPECT_THROW(Channel::tabulated("t", Spectrum({1.0, 2.0}, {0.0, -1.0})), InputError);
}

}  // namespace
}  // namespace ifov::radiometry::test_channel
