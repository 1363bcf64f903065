#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sensor/mtf.h"

namespace ifov::sensor::test_mtf {
namespace {

/// Overlap of an annulus of diameter 1 with itself, s apart, over its area: by rows.
double overlap(double s, double obscuration) {
  constexpr int kRows = 4000, kColumns = 4000;
  const auto within = [&](double x, double y) {
    const double r = 2.0 * std::hypot(x, y);
    return r <= 1.0 && r > obscuration;
  };
  double common = 0.0, all = 0.0;
  for (int row = 0; row < kRows; row += 4)
    for (int column = 0; column < kColumns; column += 4) {
      const double x = -0.5 + (column + 0.5) / kColumns, y = -0.5 + (row + 0.5) / kRows;
      if (!within(x, y)) continue;
      all += 1.0;
      if (within(x - s, y)) common += 1.0;
    }
  return common / all;
}

TEST(Mtf, OfAnAnnulusIsItsOverlapWithItself) {
  for (const double obscuration : {0.0, 0.2, 0.45, 0.7})
    for (const double s : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95})
      EXPECT_NEAR(diffraction_mtf(1.0, obscuration, s), overlap(s, obscuration), 3e-3)
          << obscuration << " " << s;
}

TEST(Mtf, WithoutObscurationWouldBeSeen) {
  EXPECT_GT(std::abs(diffraction_mtf(1.0, 0.0, 0.35) - overlap(0.35, 0.45)), 0.05);
}

TEST(Mtf, BeginsAtOneAndEndsAtTheCutoff) {
  for (const double obscuration : {0.0, 0.3}) {
    EXPECT_NEAR(diffraction_mtf(0.5, obscuration, 0.0), 1.0, 1e-12);
    EXPECT_EQ(diffraction_mtf(2.0, obscuration, 0.5), 0.0);
    EXPECT_NEAR(diffraction_mtf(0.5, obscuration, 1.0), diffraction_mtf(1.0, obscuration, 0.5), 1e-15);
  }
  EXPECT_NEAR(square_mtf(1.0, 0.5), 2.0 / std::numbers::pi, 1e-15);
  EXPECT_EQ(square_mtf(1.0, 0.0), 1.0);
  EXPECT_NEAR(gaussian_mtf(0.5, 0.5), std::exp(-std::numbers::pi * std::numbers::pi / 8.0), 1e-15);
}

}  // namespace
}  // namespace ifov::sensor::test_mtf
