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

// At a place, near and far, with and without a covered aperture: the mean of the density beyond the cut over the square.
TEST(PsfWings, DensityIsTheMeanOverTheSquare) {
  for (const double covered : {0.0, 0.4})
    for (const double q : {0.5, 0.8, 1.0, 2.0})
      for (const double fill : {1.0, 0.5}) {
        AiryAperture airy = aperture(q);
        airy.obscuration = covered;
        const auto psf = make_airy_psf(airy);
        const ifov::sampling::Point2 shift{0.2, -0.1};
        const PsfWings wings(*psf, fill, shift);
        const double side = std::sqrt(fill);
        // Where a corner of the square reaches over the cut.
        const double corner = 5e-4 * psf->cut_density(1.0001 * psf->half_width_px(), 0.0, true);
        for (double r = 3.0; r < 150.0; r *= 1.6)
          for (const double angle : {0.02, 0.785, 2.2}) {
            constexpr int kSteps = 60;
            const double x = r * std::cos(angle), y = r * std::sin(angle);
            double sum = 0.0, even = 0.0;
            for (int j = 0; j < kSteps; ++j)
              for (int i = 0; i < kSteps; ++i) {
                const double dx = x - shift.x + side * ((i + 0.5) / kSteps - 0.5),
                             dy = y - shift.y + side * ((j + 0.5) / kSteps - 0.5);
                sum += psf->cut_density(dx, dy, false) / (kSteps * kSteps);
                even += psf->cut_density(dx, dy, true) / (kSteps * kSteps);
              }
            const auto [density, half_width] = wings.density(x, y);
            EXPECT_NEAR(density, sum, half_width + 0.03 * even + corner)
                << q << " " << covered << " " << r << " " << angle;
            if (std::abs(r - psf->half_width_px()) > 1.0) {  // the cut is steep
              EXPECT_LE(half_width, 0.4 * std::max(sum, even) + 2e-6) << q << " " << r;
            }
          }
      }
}

}  // namespace test_psf_wings
