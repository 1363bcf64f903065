#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "sampling/accuracy/basis/stopping.h"
#include "sampling/hash.h"
#include "sampling/random.h"

// Do intervals hold wherever the sampling ends? Normal values, tests of growing numbers of them, an end when the
// estimated interval is narrow enough.

namespace ifov::test::test_stopping {
namespace {

using sampling::Satterthwaite;
using sampling::Stopping;

class Normal {
 public:
  explicit Normal(std::uint64_t seed) : key_(sampling::mix(seed)) {}
  double operator()() {
    key_ = sampling::mix(key_);
    const double u = sampling::unit_double(key_), v = sampling::unit_double(sampling::mix(key_ + 1));
    return std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * std::numbers::pi * v);
  }

 private:
  std::uint64_t key_;
};

using Quantile = std::function<double(int test, double freedom)>;

/// How many values there are to be: at least twice as many each time, or as the sampler plans them from the variance that those
/// there show: to the limit, or, as in clutter, a part of the way where it is far.
enum class Growth { kDoubling, kPlanned, kPartWay };

/// Share of the intervals that hold 0, the mean of replicates of variance 1 per value; `needed` independent values
/// would do for an interval at exactly known variance.
double coverage(const Quantile& quantile, int replicates, double needed, Growth growth = Growth::kDoubling) {
  constexpr int kTrials = 4000;
  const double limit = 1.96 / std::sqrt(needed);
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Normal normal(sampling::hash(replicates, static_cast<int>(needed), trial));
    std::vector<double> sum(static_cast<std::size_t>(replicates), 0.0);
    double drawn = 0.0, mean = 0.0, half_width = 0.0;
    for (int test = 2; test < Stopping::kTests; ++test) {
      const double wanted = drawn * (half_width / limit) * (half_width / limit);
      const double planned = growth == Growth::kPartWay && wanted > 1.3 * drawn ? 0.75 * wanted : wanted;
      const double grown = drawn == 0.0                  ? 2.0
                           : growth == Growth::kDoubling ? 2.0 * drawn
                                                         : std::max(1.08 * drawn, planned);
      mean = 0.0;
      for (double& s : sum) mean += (s += std::sqrt(grown - drawn) * normal()) / grown / replicates;
      drawn = grown;
      double squares = 0.0;
      for (double s : sum) squares += (s / drawn - mean) * (s / drawn - mean);
      half_width = quantile(test, replicates - 1.0) * std::sqrt(squares / (replicates - 1.0) / replicates);
      if (half_width <= limit) break;
    }
    covered += std::abs(mean) <= half_width;
  }
  return covered / static_cast<double>(kTrials);
}

TEST(Stopping, IntervalsHoldWhereverTheSamplingEnds) {
  const Stopping stopping(0.95);
  const Quantile quantile = [&](int test, double freedom) { return stopping.student(test, freedom); };
  for (int replicates : {5, 12, 24, 48, 100, 200})
    for (double needed : {60.0, 100.0, 300.0}) {
      const double held = coverage(quantile, replicates, needed);
      EXPECT_GE(held, 0.945) << replicates << " replicates, " << needed << " values";
      EXPECT_LE(held, 0.985) << replicates << " replicates, " << needed << " values";
    }
}

TEST(Stopping, IntervalsHoldWhereRoundsReachTheLimitAndDoNotPassIt) {
  const Stopping stopping(0.95);
  const Quantile quantile = [&](int test, double freedom) { return stopping.student(test, freedom); };
  for (int replicates : {5, 12, 24, 48, 100, 200})
    for (double needed : {60.0, 100.0, 300.0}) {
      for (const Growth growth : {Growth::kPlanned, Growth::kPartWay}) {
        const double held = coverage(quantile, replicates, needed, growth);
        EXPECT_GE(held, 0.945) << replicates << " replicates, " << needed << " values";
        EXPECT_LE(held, 0.985) << replicates << " replicates, " << needed << " values";
      }
    }
}

TEST(Stopping, IntervalsThatIgnoreTheTestsOrTheFreedomFail) {
  const Quantile normal = [](int, double) { return 1.96; };
  EXPECT_LT(coverage(normal, 5, 100.0), 0.9);
  const Quantile no_tests = [](int, double freedom) { return sampling::two_sided_student(0.95, freedom); };
  EXPECT_LT(coverage(no_tests, 12, 100.0), 0.945);
}

TEST(Stopping, EarlyTestsAndFewDegreesOfFreedomAskForMore) {
  const Stopping stopping(0.95);
  EXPECT_NEAR(stopping.normal(), 1.959964, 1e-6);
  EXPECT_GT(stopping.student(0, 20.0), stopping.student(1, 20.0));
  EXPECT_GT(stopping.student(1, 20.0), stopping.student(2, 20.0));
  EXPECT_GT(stopping.student(2, 3.0), stopping.student(2, 30.0));
  EXPECT_GT(stopping.student(2, 200.0), stopping.normal());
}

TEST(Stopping, OneEstimateKeepsItsFreedom) {
  Satterthwaite sum;
  sum.add(2.0, 5.0);
  EXPECT_DOUBLE_EQ(sum.variance(), 2.0);
  EXPECT_DOUBLE_EQ(sum.degrees_of_freedom(), 5.0);
}

// Sixteen estimates of one variance with three degrees of freedom each have 48 between them. The plain formula, in which
// their noise counts as real differences, would say 30.
TEST(Stopping, SatterthwaiteOfEqualPartsAddsTheirFreedom) {
  Normal normal(7);
  constexpr int kTrials = 2000, kParts = 16, kFreedom = 3;
  double told = 0.0, plainly = 0.0;
  for (int t = 0; t < kTrials; ++t) {
    Satterthwaite sum;
    double squares = 0.0;
    for (int part = 0; part < kParts; ++part) {
      double variance = 0.0;
      for (int k = 0; k < kFreedom; ++k) {
        const double x = normal();
        variance += x * x / kFreedom;
      }
      sum.add(variance, kFreedom);
      squares += variance * variance / kFreedom;
    }
    told += sum.degrees_of_freedom() / kTrials;
    plainly += sum.variance() * sum.variance() / squares / kTrials;
  }
  EXPECT_NEAR(told, kParts * kFreedom, 0.06 * kParts * kFreedom);
  EXPECT_LT(plainly, 0.75 * kParts * kFreedom);
}

}  // namespace
}  // namespace ifov::test::test_stopping
