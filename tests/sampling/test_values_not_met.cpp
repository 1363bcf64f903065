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

// Small patches of one label, far apart, with bright specks: the few values about a patch often agree by chance, and those
// of the other patches tell that they need not.
TEST(ValuesNotMet, PatchesFarOffTellWhatFewValuesHide) {
  constexpr int kSide = 12, kFine = 100;
  constexpr double kRadius_px = 0.3, kGround = 5.0, kSpecked = 40.0, kSpecks = 0.1;
  int pixels = 0, off = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto in_patch = [&](double x, double y) {
      const auto i = static_cast<std::int64_t>(std::floor(x / 4.0)),
                 j = static_cast<std::int64_t>(std::floor(y / 4.0));
      return std::hypot(x - static_cast<double>(4 * i) - 1.0 - 2.0 * unit_double(hash(seed, 7, i, j)),
                        y - static_cast<double>(4 * j) - 1.0 - 2.0 * unit_double(hash(seed, 8, i, j))) <
             kRadius_px;
    };
    const auto value = [&](double x, double y) {
      if (!in_patch(x, y)) return kGround;
      const auto i = static_cast<std::int64_t>(std::floor(20.0 * x)),
                 j = static_cast<std::int64_t>(std::floor(20.0 * y));
      return unit_double(hash(91 + seed, i, j)) < kSpecks ? kSpecked : kLevel;
    };
    ShapeField field([&](double x, double y) { return Label{in_patch(x, y) ? 2u : 1u}; },
                     [&](Label, double x, double y, int) { return static_cast<float>(value(x, y)); });
    Rendering render = three_by_three(seed);
    render.tile = render.image = {0, 0, kSide, kSide};
    render.half_width = 0.3;
    const TileResult result = render(field);
    for (int p = 0; p < kSide * kSide; ++p) {
      double sum = 0.0;
      bool any = false;
      for (int k = 0; k < kFine * kFine; ++k) {
        const double x = p % kSide + (k % kFine + 0.5) / kFine, y = p / kSide + (k / kFine + 0.5) / kFine;
        any = any || in_patch(x, y);
        sum += value(x, y);
      }
      if (!any) continue;
      ++pixels;
      off += std::abs(static_cast<double>(result.mean[p]) - sum / (kFine * kFine)) >
             static_cast<double>(result.half_width[p]);
    }
  }
  EXPECT_GT(pixels, 500);
  EXPECT_LT(off, 0.04 * pixels);
}

}  // namespace
}  // namespace ifov::test
