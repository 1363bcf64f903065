#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sampling/intervals/bounded_error.h"
#include "sampling/means/region_interval.h"
#include "sampling/pixel_footprint.h"

namespace ifov::sampling::test_region_interval {
namespace {

const BoundedError kJoint(0.95);

RegionSum sum_of(int pixels, double border_share, double air = 0.0) {
  RegionSum sum;
  for (int k = 0; k < pixels; ++k) sum.add(10.0 + k % 2, 0.1, border_share, air);
  return sum;
}

TEST(RegionInterval, OnePixelKeepsItsOwn) {
  const RegionSum sum = sum_of(1, 1.0, 0.02);
  EXPECT_EQ(sum.pixels(), 1u);
  EXPECT_DOUBLE_EQ(sum.mean(), 10.0);
  EXPECT_NEAR(sum.half_width(RegionRule::of_accuracy(1.0), kJoint), kJoint.half_width(0.1, 0.02), 1e-15);
}

TEST(RegionInterval, ManyPixelsKeepWhatIsCommonToThem) {
  const int n = 1 << 20;
  const RegionRule rule = RegionRule::of_accuracy(1.0);
  EXPECT_NEAR(sum_of(n, 1.0).half_width(rule, kJoint), 0.1 * rule.common_borders, 2e-4);
  EXPECT_NEAR(sum_of(n, 0.0).half_width(rule, kJoint), 0.1 * rule.common_paths, 2e-4);
  EXPECT_NEAR(sum_of(n, 0.0, 0.02).half_width(rule, kJoint), kJoint.half_width(0.1 * rule.common_paths, 0.02),
              2e-4);
  EXPECT_NEAR(sum_of(n, 0.0).mean(), 10.5, 1e-9);
}

TEST(RegionInterval, IndependentErrorsFallAsTheRoot) {
  EXPECT_NEAR(sum_of(400, 0.5).half_width({1.0, 0.0, 0.0}, kJoint), 0.1 / 20.0, 1e-12);
  EXPECT_NEAR(sum_of(400, 0.5).half_width({4.0, 0.0, 0.0}, kJoint), 0.1 / 10.0, 1e-12);
}

TEST(RegionInterval, IsNeverWiderThanThePixelsAreAndNothingIsLearnedWhereAllIsCommon) {
  for (const int n : {1, 2, 3, 10, 1000}) {
    EXPECT_LE(sum_of(n, 1.0).half_width(RegionRule::of_accuracy(30.0), kJoint), 0.1 + 1e-12);
    EXPECT_NEAR(sum_of(n, 1.0, 0.3).half_width(RegionRule::all_common(), kJoint), kJoint.half_width(0.1, 0.3),
                1e-12);
  }
}

TEST(RegionInterval, PixelsWithoutAValueAreLeftAwayAndUnknownErrorsStayUnknown) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  RegionSum sum = sum_of(3, 1.0);
  sum.add(kNone, kNone, 1.0);
  EXPECT_EQ(sum.pixels(), 3u);
  EXPECT_TRUE(std::isfinite(sum.half_width(RegionRule::of_accuracy(1.0), kJoint)));
  sum.add(10.0, kNone, 1.0);
  EXPECT_TRUE(std::isnan(sum.half_width(RegionRule::of_accuracy(1.0), kJoint)));
  EXPECT_TRUE(std::isnan(RegionSum().mean()));
}

TEST(ResponseArea, OfBoxesAndOfAGaussian) {
  EXPECT_EQ(response_area_px(PixelFootprint::box(1.0)), 1.0);
  EXPECT_EQ(response_area_px(PixelFootprint::box(0.5)), 1.0);
  EXPECT_NEAR(response_area_px(PixelFootprint::box(3.0)), 9.0, 1e-12);
  // The integral of a squared Gaussian is 1 / (4 pi sigma^2).
  constexpr int kCells = 201;
  constexpr double kHalf = 5.0, kSigma = 0.9;
  std::vector<double> values;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      const double x = kHalf * ((2.0 * i + 1.0) / kCells - 1.0), y = kHalf * ((2.0 * j + 1.0) / kCells - 1.0);
      values.push_back(std::exp(-(x * x + y * y) / (2.0 * kSigma * kSigma)));
    }
  const double exact = 4.0 * std::numbers::pi * kSigma * kSigma;
  EXPECT_NEAR(response_area_px(PixelFootprint::tabulated(kHalf, kCells, std::move(values))), exact,
              0.005 * exact);
}

}  // namespace
}  // namespace ifov::sampling::test_region_interval
