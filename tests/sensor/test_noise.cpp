#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sensor/noise.h"

namespace ifov::sensor::test_noise {
namespace {

constexpr int kLines = 200, kWidth = 1000;

/// Of one band, line after line.
std::vector<double> drawn(std::uint64_t seed, int band, double standard_deviation) {
  std::vector<double> all;
  for (int line = 0; line < kLines; ++line) {
    std::vector<float> values(kWidth, 0.0f);
    Noise(seed).add(line, band, standard_deviation, values);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

/// Of values whose means are 0.
double correlation(const std::vector<double>& a, const std::vector<double>& b, std::size_t shift = 0) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t k = shift; k < a.size(); ++k)
    ab += a[k] * b[k - shift], aa += a[k] * a[k], bb += b[k] * b[k];
  return ab / std::sqrt(aa * bb);
}

/// Largest distance of the distribution from the normal one, times the root of the count (Kolmogorov).
double kolmogorov(std::vector<double> values, double standard_deviation) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double below = 0.5 * std::erfc(-values[k] / standard_deviation / std::numbers::sqrt2);
    largest = std::max({largest, std::abs(below - static_cast<double>(k) / n),
                        std::abs(below - static_cast<double>(k + 1) / n)});
  }
  return std::sqrt(n) * largest;
}

/// How far the standard deviation is off, in standard errors of its estimate.
double spread_off(const std::vector<double>& values, double standard_deviation) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  const auto n = static_cast<double>(values.size());
  return (std::sqrt(squares / n) / standard_deviation - 1.0) * std::sqrt(2.0 * n);
}

// 2.2: less than one in ten thousand of normal samples is farther off.
TEST(Noise, IsNormalOfTheStandardDeviation) {
  const std::vector<double> noise = drawn(1, 0, 0.3);
  EXPECT_LT(kolmogorov(noise, 0.3), 2.2);
  EXPECT_LT(std::abs(spread_off(noise, 0.3)), 4.0);
}

TEST(Noise, OfOnePercentMoreIsSeen) { EXPECT_GT(spread_off(drawn(1, 0, 0.303), 0.3), 4.0); }

TEST(Noise, ThatIsUniformIsSeen) {
  std::vector<double> uniform;
  for (const double value : drawn(1, 0, 1.0))
    uniform.push_back(0.3 * std::sqrt(3.0) * std::erf(value / std::numbers::sqrt2));
  EXPECT_LT(std::abs(spread_off(uniform, 0.3)), 4.0);
  EXPECT_GT(kolmogorov(uniform, 0.3), 2.2);
}

TEST(Noise, IsIndependentOfItsNeighboursBandsAndRealizations) {
  const std::vector<double> noise = drawn(5, 2, 1.0);
  const double most = 4.0 / std::sqrt(kLines * kWidth);
  EXPECT_LT(std::abs(correlation(noise, noise, 1)), most);
  EXPECT_LT(std::abs(correlation(noise, noise, kWidth)), most);
  EXPECT_LT(std::abs(correlation(noise, drawn(5, 3, 1.0))), most);
  EXPECT_LT(std::abs(correlation(noise, drawn(6, 2, 1.0))), most);
  EXPECT_NEAR(correlation(noise, drawn(5, 2, 1.0)), 1.0, 1e-12);
}

TEST(Noise, LeavesGapsAndWhatHasNoneAsItIs) {
  std::vector<float> values{NAN, 2.5f};
  Noise(1).add(0, 0, 0.0, values);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], 2.5f);
  Noise(1).add(0, 0, 1.0, values);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_NE(values[1], 2.5f);
}

}  // namespace
}  // namespace ifov::sensor::test_noise
