// What few values have not met, and values nearby show, is part of the interval.
#include <gtest/gtest.h>

#include <cmath>

#include "accuracy_scenes.h"

namespace ifov::test {
namespace {

using namespace sampling;

constexpr double kLevel = 10.0, kBright = 25.0, kShare = 0.06;

/// One label with bright specks of 1/40 px, which no label tells.
double speckled(double x, double y) {
  const auto i = static_cast<std::int64_t>(std::floor(40.0 * x)),
             j = static_cast<std::int64_t>(std::floor(40.0 * y));
  return unit_double(hash(91, i, j)) < kShare ? kBright : kLevel;
}

double mean_of_pixel(int x, int y) {
  double sum = 0.0;
  for (int k = 0; k < 1600; ++k) sum += speckled(x + (k % 40 + 0.5) / 40.0, y + (k / 40 + 0.5) / 40.0);
  return sum / 1600.0;
}

TEST(ValuesNotMet, ArePartOfTheInterval) {
  constexpr int kSide = 8;
  ShapeField field([](double, double) { return Label{1}; },
                   [](Label, double x, double y, int) { return static_cast<float>(speckled(x, y)); });
  int pixels = 0, off = 0, far_off = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rendering render = three_by_three(seed);
    render.tile = render.image = {0, 0, kSide, kSide};
    render.half_width = 1.2;
    const TileResult result = render(field);
    for (int p = 0; p < kSide * kSide; ++p) {
      const double error =
          std::abs(static_cast<double>(result.mean[p]) - mean_of_pixel(p % kSide, p / kSide));
      ++pixels;
      off += error > static_cast<double>(result.half_width[p]);
      far_off += error > 1.5 * static_cast<double>(result.half_width[p]);
    }
  }
  EXPECT_LT(off, 0.035 * pixels);
  EXPECT_LE(far_off, 0.004 * pixels);
}

}  // namespace
}  // namespace ifov::test
