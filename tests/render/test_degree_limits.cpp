// An error of the degree of linear polarization, and what I, Q and U have to be known to for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiometry/spectral_nodes.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"
#include "render/tolerance/degree_limits.h"

namespace ifov::render::test_degree_limits {
namespace {

// Whatever I, Q and U are within their half-widths, the degree is within its own: corners and sides of the box of errors.
TEST(DegreeLimits, NoLightWithinTheHalfWidthsIsFurtherOff) {
  double nearest = 0.0;
  for (const double degree : {0.0, 0.003, 0.05, 0.3, 0.9})
    for (const double angle : {0.0, 0.4, 1.2}) {
      constexpr double kI = 2.0;
      const double q = kI * degree * std::cos(angle), u = kI * degree * std::sin(angle);
      const double di = 0.05, dq = 0.02, du = 0.01;
      const double half_width = degree_half_width(kI, q, u, di, dq, du);
      for (int corner = 0; corner < 27; ++corner) {
        const double e[] = {corner % 3 - 1.0, corner / 3 % 3 - 1.0, corner / 9 - 1.0};
        const double other = std::hypot(q + e[1] * dq, u + e[2] * du) / (kI + e[0] * di);
        EXPECT_LE(std::abs(other - degree), half_width * (1.0 + 1e-12)) << degree << " " << angle;
        nearest = std::max(nearest, std::abs(other - degree) / half_width);
      }
    }
  EXPECT_GT(nearest, 0.9) << "half-widths are wider than they have to be";
}

TEST(DegreeLimits, KeepTheDegreeWithinWhatIsAsked) {
  for (const double degree : {0.0, 0.02, 0.5, 1.0})
    for (const double error : {0.001, 0.005, 0.1}) {
      const DegreeLimits limits = degree_limits(degree, error);
      EXPECT_LE(degree_half_width(1.0, degree, 0.0, limits.i, limits.qu, limits.qu), error * (1.0 + 1e-9));
      EXPECT_GE(degree_half_width(1.0, degree, 0.0, limits.i, limits.qu, limits.qu), 0.99 * error);
      // Planted fault: half-widths that a radiance within `error` of itself would have.
      EXPECT_GT(degree_half_width(1.0, degree, 0.0, error, error, error), 1.3 * error);
    }
  EXPECT_EQ(degree_half_width(1.0, 0.5, 0.0, 1.0, 0.1, 0.1), 1.0)
      << "of light that may be none nothing is known";
}

TEST(DegreeLimits, AToleranceAsksThemOfIQAndU) {
  const std::vector<radiometry::Channel> channels = {radiometry::Channel::monochromatic("a", 0.5),
                                                     radiometry::Channel::monochromatic("b", 0.6)};
  const auto nodes = radiometry::SpectralNodes::build(channels, radiometry::Spectrum(), {});
  const ChannelBrightness brightness(nodes);
  AccuracyRequest request;
  request.unit = ErrorUnit::polarization;
  request.error = 0.005;
  request.channels = {1};
  AccuracyTolerance tolerance(request, brightness, {400.0, 200.0}, 1);
  tolerance.judge_stokes(true);
  const double mean[] = {50.0, 20.0, 30.0, 6.0, 10.0, -8.0, 0.0, 0.1};
  double limit[8];
  tolerance.limits(mean, limit);
  const DegreeLimits asked = degree_limits(0.5, 0.005);
  for (const int unjudged : {0, 2, 4, 6, 7}) EXPECT_TRUE(std::isinf(limit[unjudged])) << unjudged;
  EXPECT_NEAR(limit[1], 20.0 * asked.i, 1e-12);
  EXPECT_NEAR(limit[3], 20.0 * asked.qu, 1e-12);
  EXPECT_NEAR(limit[5], 20.0 * asked.qu, 1e-12);
  // Of the dark, light of 0.1 % of a white surface is asked for, not nothing.
  const double dark[8] = {};
  tolerance.limits(dark, limit);
  EXPECT_NEAR(limit[3], 0.2 * degree_limits(0.0, 0.005).qu, 1e-9);
}

}  // namespace
}  // namespace ifov::render::test_degree_limits
