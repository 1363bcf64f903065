#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "radiometry/channel.h"
#include "radiometry/spectral_nodes.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/atmosphere_budget.h"
#include "render/tolerance/channel_brightness.h"
#include "sampling/intervals/bounded_error.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/tile.h"

namespace ifov::render::test_atmosphere_budget {
namespace {

const sampling::BoundedError kJoint(0.95);

/// Two channels; the first is judged to 2 %.
class AtmosphereBudget : public testing::Test {
 protected:
  static constexpr double kWhite = 100.0;
  AccuracyTolerance tolerance(double error) const {
    AccuracyRequest request;
    request.error = error;
    request.floor = 0.0;
    request.channels = {0};
    return AccuracyTolerance(request, brightness_, {kWhite, kWhite}, 1, {}, air_);
  }
  sampling::TileResult tile(float mean, float half_width) const {
    sampling::TileResult result;
    result.reset({0, 0, 1, 1}, 2);
    result.mean = {mean, mean};
    result.half_width = {half_width, half_width};
    result.reasons = {0};
    return result;
  }
  static radiometry::SpectralNodes nodes() {
    const std::array channels{radiometry::Channel::top_hat("a", 0.5, 0.6),
                              radiometry::Channel::top_hat("b", 0.6, 0.7)};
    return radiometry::SpectralNodes::build(channels, radiometry::Spectrum::constant(1000.0), {});
  }
  ChannelBrightness brightness_{nodes()};
  // 0.1 of the path, 0.5 % of surfaces, 1 % of skylight; path 10, white under the sky 20.
  AtmosphereHalfWidth one_{0.1, 0.005, 0.01, 10.0, 20.0, 30.0, 0.04, 0.002, 0.001};
  std::vector<AtmosphereHalfWidth> air_{one_, one_};
};

TEST_F(AtmosphereBudget, IsThePathAndWhatSurfacesSend) {
  EXPECT_DOUBLE_EQ(one_.of(5.0), 0.1);
  EXPECT_DOUBLE_EQ(one_.of(20.0), 0.1 + 0.05 + 0.1);
  EXPECT_DOUBLE_EQ(one_.of(110.0), 0.1 + 0.5 + 0.2);  // no surface reflects more of the sky than a white one
  EXPECT_DOUBLE_EQ(one_.of_nodes(5.0), 0.04);
  EXPECT_DOUBLE_EQ(one_.of_nodes(110.0), 0.04 + 0.2 + 0.02);
}

// Ground as bright as the air behind which it lies hides the model's error, but for a quarter; other ground shows it.
TEST_F(AtmosphereBudget, TheModelsErrorIsOfTheContrast) {
  AtmosphereHalfWidth air = one_;
  air.model_surface = 0.1, air.model_emission = -2.0, air.model_path = 0.5, air.model_sky = 0.05;
  EXPECT_DOUBLE_EQ(air.of_model(30.0),
                   0.25 * 4.0 + 0.5 + 1.0);  // 20 from the ground: 2 more of it, 2 less of the air
  EXPECT_DOUBLE_EQ(air.of_model(110.0), 8.0 + 0.5 + 1.0);
  EXPECT_DOUBLE_EQ(air.of_model(10.0), 2.0 + 0.5);
  EXPECT_EQ(air.in_interval(30.0), 0.0);
  air.model_counted = 1.0;
  EXPECT_DOUBLE_EQ(air.in_interval(30.0), air.of_model(30.0));
}

// Where intervals hold it, what was asked for is judged by all that they hold.
TEST_F(AtmosphereBudget, TheModelsErrorIsJudgedWhereIntervalsHoldIt) {
  const auto widened = [&](double counted, double model) {
    air_.assign(2, one_);
    for (AtmosphereHalfWidth& one : air_) one.model_surface = model, one.model_counted = counted;
    const AccuracyTolerance limits = tolerance(0.02);
    sampling::TileResult result = tile(110.0f, 0.5f);
    widen(air_, &limits, result);
    result.join_bounds(limits.joint());
    return result;
  };
  const sampling::TileResult without = widened(0.0, 0.1), with = widened(1.0, 0.1), bare = widened(0.0, 0.0);
  EXPECT_EQ(without.half_width, bare.half_width);
  EXPECT_TRUE(without.converged(0));
  const float all = static_cast<float>(kJoint.half_width(0.5, one_.of(110.0) + 10.0));
  EXPECT_FLOAT_EQ(with.half_width[0], all);
  EXPECT_FLOAT_EQ(with.half_width[1], all);
  EXPECT_FLOAT_EQ(with.worst_ratio[0], with.half_width[0] / 2.2f);
  EXPECT_EQ(with.reasons[0], sampling::bit(sampling::Reason::air));
  EXPECT_TRUE(widened(1.0, 0.001).converged(0));
}

// Rays end where they add a third of what the air alone is wrong by, if that is more than what is asked for.
TEST_F(AtmosphereBudget, RaysAreNotSpentOnWhatTheAirCannotKeep) {
  for (AtmosphereHalfWidth& one : air_) one.model_surface = 0.1, one.model_counted = 1.0;
  std::vector<double> mean{60.0, 60.0}, limit(2);
  tolerance(0.01).limits(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], (one_.of(60.0) + 5.0) / 3.0);
  EXPECT_NEAR(tolerance(0.01).atmosphere_share(0, 60.0), (one_.of(60.0) + 5.0) / 0.6, 1e-12);
  tolerance(0.2).limits(mean, limit);
  EXPECT_NEAR(kJoint.half_width(limit[0], one_.of(60.0) + 5.0), 12.0, 1e-12);
  for (AtmosphereHalfWidth& one : air_) one.model_counted = 0.0;
  tolerance(0.01).limits(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], 0.3);
}

TEST_F(AtmosphereBudget, LeavesTheRestToTheSampler) {
  const AccuracyTolerance limits = tolerance(0.02);
  std::vector<double> mean{60.0, 60.0}, limit(2);
  limits.asked(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], 1.2);
  EXPECT_TRUE(std::isinf(limit[1]));
  limits.limits(mean, limit);
  EXPECT_NEAR(kJoint.half_width(limit[0], one_.of(60.0)), 1.2, 1e-12);
  EXPECT_GT(limit[0], 1.2 - one_.of(60.0));
  EXPECT_TRUE(std::isinf(limit[1]));
  // Where the air takes more than half, the sampler stops at half: no rays make up for the air.
  tolerance(0.01).limits(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], 0.3);
  tolerance(0.005).limits(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], one_.of(60.0) / 3.0);
}

TEST_F(AtmosphereBudget, WidensIntervalsByABound) {
  const AccuracyTolerance limits = tolerance(0.02);
  sampling::TileResult result = tile(60.0f, 0.6f);
  widen(air_, &limits, result);
  EXPECT_FLOAT_EQ(result.half_width[0], 0.6f);
  result.join_bounds(limits.joint());
  EXPECT_FLOAT_EQ(result.half_width[0], static_cast<float>(kJoint.half_width(0.6, one_.of(60.0))));
  EXPECT_FLOAT_EQ(result.half_width[1], result.half_width[0]);
  EXPECT_FLOAT_EQ(result.worst_ratio[0], result.half_width[0] / 1.2f);
  EXPECT_TRUE(result.converged(0));
}

// Means that are off by the whole error of the air, always to the same side, stay in the interval as often as it says; with
// the air added as if it were one more independent error they would not.
TEST_F(AtmosphereBudget, HoldsABiasThatNothingAveragesOut) {
  const double bias = one_.of(60.0), sigma = 0.1, statistical = sigma * sampling::two_sided_normal(0.95);
  sampling::TileResult result = tile(60.0f, static_cast<float>(statistical));
  widen(air_, nullptr, result);
  result.join_bounds(joint_of(nullptr));
  const auto held = [&](double width) {
    const auto below = [&](double x) { return 0.5 * std::erfc(-(x - bias) / sigma / std::numbers::sqrt2); };
    return below(width) - below(-width);
  };
  EXPECT_GE(held(static_cast<double>(result.half_width[0])), 0.95 - 1e-6);
  EXPECT_LT(held(std::hypot(bias, statistical)), 0.9);
}

TEST_F(AtmosphereBudget, SaysWhereTheAirIsTooCoarse) {
  const AccuracyTolerance limits = tolerance(0.005);
  sampling::TileResult result = tile(60.0f, 0.14f);
  widen(air_, &limits, result);
  EXPECT_GT(result.worst_ratio[0], 1.0f);
  EXPECT_EQ(result.reasons[0], sampling::bit(sampling::Reason::air));
  EXPECT_NEAR(limits.atmosphere_share(0, 60.0), one_.of(60.0) / 0.3, 1e-12);
}

TEST_F(AtmosphereBudget, IsNotBlamedForWhatTheSamplerDidNotReach) {
  const AccuracyTolerance limits = tolerance(0.02);
  sampling::TileResult result = tile(60.0f, 2.0f);
  result.reasons = {sampling::bit(sampling::Reason::samples)};
  widen(air_, &limits, result);
  EXPECT_EQ(result.reasons[0], sampling::bit(sampling::Reason::samples));
  // But where it would not have left room either, both are said.
  const AccuracyTolerance strict = tolerance(0.005);
  widen(air_, &strict, result);
  EXPECT_EQ(result.reasons[0],
            sampling::bit(sampling::Reason::samples) | sampling::bit(sampling::Reason::air));
}

TEST_F(AtmosphereBudget, WithoutErrorsNothingChanges) {
  sampling::TileResult result = tile(60.0f, 0.6f);
  widen(std::span<const AtmosphereHalfWidth>(), nullptr, result);
  EXPECT_FLOAT_EQ(result.half_width[0], 0.6f);
  sampling::TileResult single;
  single.reset({0, 0, 1, 1}, 2, false);
  widen(air_, nullptr, single);
  EXPECT_TRUE(single.half_width.empty());
}

}  // namespace
}  // namespace ifov::render::test_atmosphere_budget
