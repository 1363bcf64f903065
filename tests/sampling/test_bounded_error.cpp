#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "sampling/intervals/bounded_error.h"
#include "sampling/intervals/quantiles.h"

namespace ifov::sampling::test_bounded_error {
namespace {

/// P(|N(bias, sigma)| < half_width).
double held(double half_width, double bias, double sigma) {
  const auto below = [&](double x) { return 0.5 * std::erfc(-(x - bias) / sigma / std::numbers::sqrt2); };
  return below(half_width) - below(-half_width);
}

TEST(BoundedError, HoldsAsOftenAsItSaysWhereTheBoundIsReachedAndOftenerWhereNot) {
  for (const double confidence : {0.68, 0.95, 0.999}) {
    const BoundedError joint(confidence);
    const double normal = two_sided_normal(confidence);
    for (const double t : {0.0, 0.03, 0.3, 0.77, 1.0, 1.5, 2.5, 4.9, 7.0, 100.0}) {
      const double sigma = 0.2, bound = t * sigma, width = joint.half_width(normal * sigma, bound);
      EXPECT_GE(held(width, bound, sigma), confidence - 1e-12) << t;
      EXPECT_LE(held(width, bound, sigma), confidence + 2e-3 * (1.0 - confidence)) << t;
      EXPECT_GE(held(width, 0.3 * bound, sigma), confidence - 1e-12) << t;
    }
  }
}

// The quantiles of noncentral chi squared with one degree of freedom; those of one side where the bound is large.
TEST(BoundedError, LiesBetweenTheSumAndTheLarger) {
  const BoundedError joint(0.95);
  EXPECT_EQ(joint.half_width(0.3, 0.0), 0.3);
  EXPECT_EQ(joint.half_width(0.0, 0.3), 0.3);
  EXPECT_NEAR(joint.half_width(1.959963984540054, 1.0), 2.64614554821531, 1e-9);
  EXPECT_NEAR(joint.half_width(1.959963984540054, 50.0), 50.0 + 1.6448536269514722, 1e-9);
  for (double bound = 0.01; bound < 10.0; bound *= 1.3) {
    const double width = joint.half_width(1.0, bound);
    EXPECT_GE(width, std::max(1.0, bound));
    EXPECT_LE(width, 1.0 + bound);
  }
}

// Squares may not be added: the bound is the same in all pixels, and those of one side are missed.
TEST(BoundedError, ARootOfTheSumOfSquaresWouldBeTooNarrow) {
  const BoundedError joint(0.95);
  const double normal = two_sided_normal(0.95);
  EXPECT_LT(held(std::hypot(normal, 2.0), 2.0, 1.0), 0.8);
  EXPECT_GE(held(joint.half_width(normal, 2.0), 2.0, 1.0), 0.95 - 1e-12);
}

TEST(BoundedError, HoldsTheMoreWhereFewValuesTellTheScatter) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const BoundedError joint(0.95);
  for (const int values : {4, 9, 33})
    for (const double t : {0.5, 2.0}) {
      constexpr int kTrials = 200000;
      const double student = two_sided_student(0.95, values - 1.0), bound = t / std::sqrt(values);
      int inside = 0;
      for (int trial = 0; trial < kTrials; ++trial) {
        double mean = 0.0, squares = 0.0;
        for (int k = 1; k <= values; ++k) {
          const double x = normal(random), old = mean;
          mean += (x - mean) / k;
          squares += (x - old) * (x - mean);
        }
        const double width = joint.half_width(student * std::sqrt(squares / (values - 1.0) / values), bound);
        inside += std::abs(mean + bound) <= width ? 1 : 0;
      }
      EXPECT_GT(inside / static_cast<double>(kTrials), 0.95 - 3.0 * std::sqrt(0.95 * 0.05 / kTrials))
          << values << " " << t;
    }
}

TEST(BoundedError, TheInversesAre) {
  const BoundedError joint(0.95);
  for (const double random : {1e-3, 0.1, 1.0, 30.0})
    for (double bound = 1e-4; bound < 100.0; bound *= 1.7) {
      const double width = joint.half_width(random, bound);
      EXPECT_NEAR(joint.random(width, bound), random, 1e-9 * width);
      EXPECT_NEAR(joint.bound(width, random), bound, 1e-9 * width);
    }
  EXPECT_EQ(joint.random(0.2, 0.3), 0.0);
  EXPECT_EQ(joint.random(0.2, 0.0), 0.2);
}

TEST(BoundedError, WhatIsNotKnownStaysSo) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(),
                   kAll = std::numeric_limits<double>::infinity();
  const BoundedError joint(0.95);
  EXPECT_TRUE(std::isnan(joint.half_width(kNone, 1.0)));
  EXPECT_EQ(joint.half_width(kAll, 1.0), kAll);
  EXPECT_EQ(joint.half_width(1.0, kAll), kAll);
  EXPECT_EQ(joint.random(kAll, 1.0), kAll);
}

}  // namespace
}  // namespace ifov::sampling::test_bounded_error
