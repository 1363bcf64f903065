#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "math/normal.h"

namespace ifov::math::test_normal {
namespace {

TEST(NormalQuantile, InvertsTheComplementaryErrorFunction) {
  for (int k = -300; k <= 300; ++k) {
    const double x = 0.025 * k;  // into both tails, over the borders of the approximations
    const double below = 0.5 * std::erfc(-std::min(x, 0.0) / std::numbers::sqrt2);
    const double probability = x <= 0.0 ? below : 0.5 * std::erfc(-x / std::numbers::sqrt2);
    // Above the middle the probability itself has lost digits.
    const double slope = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    EXPECT_NEAR(normal_quantile(probability), x, 1e-14 * std::abs(x) + 3e-16 / slope) << x;
    if (probability == 1.0) break;
  }
}

TEST(NormalQuantile, OfManyIsThatOfEach) {
  std::vector<double> many;
  for (int k = 1; k < 1000; ++k) many.push_back(k < 100 ? std::pow(0.8, k) : 0.001 * k);
  std::vector<double> each;
  for (const double probability : many) each.push_back(normal_quantile(probability));
  normal_quantiles(many);
  EXPECT_EQ(many, each);
}

TEST(NormalQuantile, KnowsTheTables) {
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 1e-12);
}

}  // namespace
}  // namespace ifov::math::test_normal
