#include <gtest/gtest.h>

#include <cmath>

#include "radiometry/planck.h"
#include "radiometry/spectral_nodes.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"

namespace ifov::render::test_accuracy_tolerance {
namespace {

radiometry::SpectralNodes nodes_at(double wavelength_um) {
  const std::vector<radiometry::Channel> channels = {radiometry::Channel::monochromatic("c", wavelength_um)};
  return radiometry::SpectralNodes::build(channels, radiometry::Spectrum(), {});
}

TEST(ChannelBrightness, InvertsPlanck) {
  const auto nodes = nodes_at(8.5);
  const ChannelBrightness brightness(nodes);
  for (const double t : {180.0, 250.3, 293.15, 303.746, 313.15, 800.7}) {
    const double radiance = radiometry::planck_w_m2_sr_um(8.5, t);
    EXPECT_NEAR(brightness.temperature_k(0, radiance), t, 2e-3);
    EXPECT_NEAR(brightness.slope_w_m2_sr_um_k(0, radiance), radiometry::planck_slope_w_m2_sr_um_k(8.5, t),
                3e-3 * radiometry::planck_slope_w_m2_sr_um_k(8.5, t));
  }
}

TEST(AccuracyTolerance, KelvinUsesTheSlopeAtThePixel) {
  const auto nodes = nodes_at(8.5);
  const ChannelBrightness brightness(nodes);
  AccuracyRequest request;
  request.unit = ErrorUnit::kelvin;
  request.error = 0.1;
  const AccuracyTolerance tolerance(request, brightness, {0.0}, 9);
  const double mean[] = {10.239994};  // a half-and-half mix of 20 and 40 degC
  double limit[1];
  tolerance.limits(mean, limit);
  EXPECT_NEAR(limit[0], 0.1 * 0.188585, 1e-5);
}

TEST(AccuracyTolerance, PercentHasAFloorAndUnjudgedChannelsNone) {
  const auto nodes = nodes_at(0.6);
  const ChannelBrightness brightness(nodes);
  AccuracyRequest request;
  request.error = 0.01;
  const AccuracyTolerance tolerance(request, brightness, {400.0}, 1);
  double limit[1];
  const double bright[] = {100.0}, dark[] = {0.0};
  tolerance.limits(bright, limit);
  EXPECT_DOUBLE_EQ(limit[0], 1.0);
  tolerance.limits(dark, limit);
  EXPECT_NEAR(limit[0], 0.4, 1e-9);
}

TEST(AccuracyTolerance, AsksForNothingFinerThanSinglePrecision) {
  const auto nodes = nodes_at(1.9);
  const ChannelBrightness brightness(nodes);
  AccuracyRequest request;
  request.unit = ErrorUnit::radiance;
  request.error = 1e-9;
  double limit[1];
  const double mean[] = {0.0066};
  AccuracyTolerance(request, brightness, {1.0}, 1).limits(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], 1e-5 * mean[0]);
}

TEST(AccuracyTolerance, ReflectanceIsNotJudgedWhereTheAirHidesTheSurface) {
  const std::vector<radiometry::Channel> channels = {radiometry::Channel::monochromatic("hidden", 1.9),
                                                     radiometry::Channel::monochromatic("seen", 1.7)};
  const auto nodes = radiometry::SpectralNodes::build(channels, radiometry::Spectrum(), {});
  const ChannelBrightness brightness(nodes);
  AccuracyRequest request;
  request.unit = ErrorUnit::reflectance;
  request.error = 0.02;
  double limit[2];
  const double glint[] = {1e4, 1e4};  // the brightest pixel hides nothing
  const AccuracyTolerance tolerance(request, brightness, {1e-9, 40.0}, 1, {0.0066, 3.0});
  tolerance.limits(glint, limit);
  EXPECT_TRUE(std::isinf(limit[0]));
  EXPECT_DOUBLE_EQ(limit[1], 0.02 * 40.0);
  EXPECT_FALSE(tolerance.judged(0));
  // Where nothing else is left, what was asked for is judged as far as it goes.
  const AccuracyTolerance alone(request, brightness, {1e-9}, 1, {0.0066});
  const double air[] = {0.0066};
  alone.limits(air, limit);
  EXPECT_DOUBLE_EQ(limit[0], 1e-5 * air[0]);
}

TEST(AccuracyTolerance, SimultaneousConfidenceIsTighterPerStatement) {
  const auto nodes = nodes_at(8.5);
  const ChannelBrightness brightness(nodes);
  AccuracyRequest request;
  request.simultaneous = true;
  const AccuracyTolerance tolerance(request, brightness, {0.0}, 100);
  EXPECT_NEAR(std::pow(tolerance.confidence(), 100.0), 0.95, 1e-9);
}

}  // namespace
}  // namespace ifov::render::test_accuracy_tolerance
