#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sensor/airy_aperture.h"
#include "sensor/psf.h"
#include "sensor/psf_wings.h"

namespace test_psf_wings {
using namespace ifov::sensor;

namespace {

AiryAperture aperture(double q_px) { return {10.0, 0.02, 0.04 * q_px, 20e-6}; }

double near_sum(const PsfWings& wings) {
  double sum = 0.0;
  for (int row = -24; row < 24; ++row)
    for (int column = -24; column < 24; ++column) sum += wings.half_cell(column, row);
  return sum;
}

}  // namespace

// Traced core, wings and what lies beyond 192 px, of which the pattern's energy says 1 - E = 2 / (pi v), are all there is.
TEST(PsfWings, SharesAddUpToAllEnergy) {
  for (const double q : {0.15, 0.5, 1.0, 1.7, 3.0}) {
    const auto psf = make_airy_psf(aperture(q));
    const PsfWings wings(*psf, 1.0);
    double far = 0.0;
    for (int y = -12; y < 12; y += 4)
      for (int x = -12; x < 12; x += 4) far -= wings.square(x, y, 4);
    for (int y = -192; y < 192; y += 16)
      for (int x = -192; x < 192; x += 16) far += wings.square(x, y, 16);
    // Over a square of half width R instead of a circle: the density q / (pi^3 r^3) leaves 4 sqrt(2) q / (pi^3 R) outside.
    const double outside = 4.0 * std::numbers::sqrt2 * q / std::pow(std::numbers::pi, 3) / 192.0;
    EXPECT_NEAR(wings.kept() + near_sum(wings) + far + outside, 1.0, 3e-4) << q;
    EXPECT_NEAR(wings.kept(), 0.95, 1e-12);
  }
}

TEST(PsfWings, FarSquaresFollowTheMeanOfTheRings) {
  const double q = 0.5, x = 40.0;
  const PsfWings wings(*make_airy_psf(aperture(q)), 1.0);
  EXPECT_NEAR(wings.square(40, -2, 4) / (16.0 * q / std::pow(std::numbers::pi, 3) / std::pow(x + 1.5, 3)),
              1.0, 0.01);
}

TEST(PsfWings, AreAlikeToAllSidesAndZeroWithinTheCore) {
  const PsfWings wings(*make_airy_psf(aperture(1.0)), 1.0);
  EXPECT_EQ(wings.half_cell(0, 0), 0.0);
  EXPECT_EQ(wings.half_cell(3, -2), 0.0);
  for (int k = 0; k < 20; ++k) {
    EXPECT_NEAR(wings.half_cell(k, 5), wings.half_cell(1 - k, 5), 1e-9);
    EXPECT_NEAR(wings.half_cell(k, 5), wings.half_cell(5, k), 1e-9);
  }
  EXPECT_GT(wings.half_cell(10, 0), 0.0);
}

}  // namespace test_psf_wings
