#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sampling/random.h"
#include "studies/common/exact_area.h"

namespace ifov::studies::test_exact_area {
namespace {

/// Fraction of a fine midpoint grid over [0, 1]^2 times the rectangle's area.
template <class Inside>
double counted(double x0, double y0, double x1, double y1, Inside inside) {
  constexpr int kFine = 800;
  int n = 0;
  for (int j = 0; j < kFine; ++j)
    for (int i = 0; i < kFine; ++i)
      n += inside(x0 + (x1 - x0) * (i + 0.5) / kFine, y0 + (y1 - y0) * (j + 0.5) / kFine);
  return (x1 - x0) * (y1 - y0) * n / (kFine * kFine);
}

TEST(ExactArea, DiscClosedForms) {
  const Disc disc{0.0, 0.0, 2.0};
  EXPECT_NEAR(area_in_rectangle(disc, -3, -3, 3, 3), 4.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(area_in_rectangle(disc, 0, 0, 3, 3), std::numbers::pi, 1e-12);
  EXPECT_NEAR(area_in_rectangle(disc, -1, -1, 1, 1), 4.0, 1e-12);
  EXPECT_NEAR(area_in_rectangle(disc, 2.1, -1, 3, 1), 0.0, 1e-12);
  // Circular segment beyond x = 1: r^2 acos(1/2) - sqrt(3).
  EXPECT_NEAR(area_in_rectangle(disc, 1, -3, 3, 3), 4.0 * std::acos(0.5) - std::sqrt(3.0), 1e-12);
}

TEST(ExactArea, DiscAgainstCounting) {
  for (int k = 0; k < 20; ++k) {
    const auto u = [&](int what) { return sampling::unit_double(sampling::hash(3, k, what)); };
    const Disc disc{2.0 * u(0) - 0.5, 2.0 * u(1) - 0.5, 0.1 + u(2)};
    EXPECT_NEAR(area_in_rectangle(disc, 0, 0, 1, 1),
                counted(0, 0, 1, 1,
                        [&](double x, double y) {
                          return std::hypot(x - disc.x_px, y - disc.y_px) < disc.radius_px;
                        }),
                3e-4);
  }
}

TEST(ExactArea, PixelsOfADiscAddUp) {
  const Disc disc{1.37, 1.61, 0.9};
  double sum = 0.0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) sum += area_in_rectangle(disc, i, j, i + 1, j + 1);
  EXPECT_NEAR(sum, std::numbers::pi * 0.81, 1e-12);
}

TEST(ExactArea, OblongKeepsItsAreaAndClips) {
  const Outline rod = oblong(1.5, 1.5, 1.2, 0.03, 0.7);
  EXPECT_NEAR(area(rod), 0.036, 1e-15);
  EXPECT_NEAR(area_in_rectangle(rod, 0, 0, 3, 3), 0.036, 1e-15);
  EXPECT_NEAR(area_in_rectangle(rod, 0, 0, 1.5, 3), 0.018, 1e-12);  // through its centre
  EXPECT_EQ(area_in_rectangle(rod, 4, 4, 5, 5), 0.0);
}

TEST(ExactArea, ConcaveOutline) {
  const Outline corner{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_NEAR(area(corner), 3.0, 1e-15);
  EXPECT_NEAR(area_in_rectangle(corner, 0.5, 0.5, 1.5, 1.5), 0.75, 1e-15);
}

}  // namespace
}  // namespace ifov::studies::test_exact_area
