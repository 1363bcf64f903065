#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sampling/accuracy/basis/stopping.h"
#include "sampling/accuracy/radiance/sequence_gains.h"
#include "sampling/hash.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/random.h"

// Variances as Smyth (2004) has them: of output o sigma^2 = s0^2 d0 / chi^2_d0, and its own estimate sigma^2 chi^2_d / d.

namespace ifov::test::test_sequence_gains {
namespace {

using sampling::SequenceGain;
using sampling::SequenceGains;

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : key_(sampling::mix(seed)) {}
  double normal() {
    key_ = sampling::mix(key_);
    const double u = sampling::unit_double(key_), v = sampling::unit_double(sampling::mix(key_ + 1));
    return std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * std::numbers::pi * v);
  }
  double chi_squared(int freedom) {
    double sum = 0.0;
    for (int i = 0; i < freedom; ++i) {
      const double x = normal();
      sum += x * x;
    }
    return sum;
  }

 private:
  std::uint64_t key_;
};

struct Output {
  double variance;  // true
  SequenceGain own;
};

std::vector<Output> draw(int count, double level, int prior_freedom, int own_freedom, std::uint64_t seed) {
  Draws draws(seed);
  std::vector<Output> outputs;
  for (int i = 0; i < count; ++i) {
    const double variance = level * prior_freedom / draws.chi_squared(prior_freedom);
    outputs.push_back(
        {variance,
         {variance * draws.chi_squared(own_freedom) / own_freedom, static_cast<double>(own_freedom)}});
  }
  return outputs;
}

constexpr std::uint32_t kLabel = 7;
constexpr double kValues = 200.0;

SequenceGains pool(const std::vector<Output>& outputs) {
  SequenceGains gains;
  for (const Output& output : outputs) gains.add(kLabel, output.own, kValues);
  gains.settle();
  return gains;
}

/// What like outputs tell alone: level and degrees of freedom.
SequenceGain told(const SequenceGains& gains, double values = kValues) {
  constexpr double kNothing = 1e-9;
  SequenceGain like = gains.moderated(kLabel, {1.0, kNothing}, values);
  like.freedom -= kNothing;
  return like;
}

TEST(SequenceGains, TellLevelAndFreedomOfTheirPrior) {
  for (const int prior_freedom : {6, 12, 24}) {
    const SequenceGain like = told(pool(draw(6000, 0.3, prior_freedom, 12, 3)));
    EXPECT_NEAR(like.value, 0.3, 0.03 * 0.3) << prior_freedom;
    EXPECT_NEAR(like.freedom, prior_freedom, 0.15 * prior_freedom);
  }
}

// psi and psi_1 of integers by Abramowitz and Stegun (1964), table 6.1 (psi(10) and psi(6) less the logarithm) and eq. 6.4.3.
TEST(SequenceGains, AreSmythsToTheDigits) {
  constexpr double kOwnFreedom = 12.0, kPsi1Of6 = 0.1813229557, kPsiOf6 = -0.0856418008;
  constexpr double kPriorFreedom = 20.0, kPsi1Of10 = 0.1051663357, kPsiOf10 = -0.0508325040;
  constexpr int kOutputs = 100;
  // Logarithms that differ by exactly what both degrees of freedom make of them.
  const double apart = std::sqrt((kPsi1Of10 + kPsi1Of6) * (kOutputs - 2.0) / kOutputs);
  SequenceGains gains;
  for (int k = 0; k < kOutputs; ++k)
    gains.add(kLabel, {0.3 * std::exp(k % 2 == 0 ? apart : -apart), kOwnFreedom}, kValues);
  gains.settle();
  const SequenceGain like = told(gains);
  EXPECT_NEAR(like.freedom, kPriorFreedom, 0.003 * kPriorFreedom);
  EXPECT_NEAR(like.value, 0.3 * std::exp(kPsiOf10 - kPsiOf6), 1e-4 * 0.3);
  const SequenceGain known = gains.moderated(kLabel, {0.7, 5.0}, kValues);
  EXPECT_NEAR(known.freedom, 5.0 + like.freedom, 1e-9);
  EXPECT_NEAR(known.value, (5.0 * 0.7 + like.freedom * like.value) / known.freedom, 1e-7);
}

double coverage(const std::vector<Output>& outputs, const SequenceGains& gains, bool moderate) {
  Draws draws(99);
  int covered = 0;
  for (const Output& output : outputs) {
    const SequenceGain known = gains.moderated(kLabel, output.own, kValues);
    const double quantile = sampling::two_sided_student(0.95, static_cast<int>(known.freedom));
    const double deviation = std::sqrt(moderate ? known.value : output.own.value);
    covered += std::abs(std::sqrt(output.variance) * draws.normal()) <= quantile * deviation;
  }
  return covered / static_cast<double>(outputs.size());
}

TEST(SequenceGains, ModeratedIntervalsHold) {
  const std::vector<Output> outputs = draw(8000, 0.5, 20, 5, 11);
  const SequenceGains gains = pool(outputs);
  EXPECT_NEAR(coverage(outputs, gains, true), 0.95, 0.008);
}

// The freedom of all with the variance of one alone.
TEST(SequenceGains, PlantedBorrowedFreedomIsFound) {
  const std::vector<Output> outputs = draw(8000, 0.5, 20, 5, 11);
  EXPECT_LT(coverage(outputs, pool(outputs), false), 0.93);
}

TEST(SequenceGains, OutputsThatAreNotAlikeTellLittle) {
  std::vector<Output> outputs = draw(500, 0.1, 400, 12, 5);
  EXPECT_GT(told(pool(outputs)).freedom, 40.0);
  for (const Output& output : draw(500, 0.8, 400, 12, 6)) outputs.push_back(output);
  EXPECT_LT(told(pool(outputs)).freedom, 5.0);
}

TEST(SequenceGains, FollowTheNumberOfValues) {
  SequenceGains gains;
  for (int k = 0; k < 40; ++k) {
    const double values = 50.0 * std::pow(2.0, k / 8.0);
    for (const Output& output : draw(50, 0.6 * std::pow(values / 50.0, -0.5), 400, 12, 20 + k))
      gains.add(kLabel, output.own, values);
  }
  gains.settle();
  for (const double values : {50.0, 200.0, 800.0})
    EXPECT_NEAR(told(gains, values).value / (0.6 * std::pow(values / 50.0, -0.5)), 1.0, 0.05) << values;
  // Not beyond what was seen.
  EXPECT_DOUBLE_EQ(told(gains, 1e9).value, told(gains, 50.0 * std::pow(2.0, 39 / 8.0)).value);
}

TEST(SequenceGains, FewOutputsAreLeftAsTheyAre) {
  const std::vector<Output> outputs = draw(30, 0.3, 400, 12, 8);
  const SequenceGain own = outputs.front().own, known = pool(outputs).moderated(kLabel, own, kValues);
  EXPECT_EQ(known.value, own.value);
  EXPECT_EQ(known.freedom, own.freedom);
}

}  // namespace
}  // namespace ifov::test::test_sequence_gains
