#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "accuracy_scenes.h"
#include "sampling/accuracy/basis/stopping.h"

// A tile that is taken from a looser to a tighter tolerance: what it costs, whether its intervals hold.

namespace ifov::test::test_refine {
namespace {

/// Patches of five radiances, askew, whose paths are noisy.
class Patches final : public sampling::Field {
 public:
  Patches(double size_px, double sigma, std::uint64_t seed) : size_px_(size_px), sigma_(sigma), seed_(seed) {}
  int columns() const override { return 1; }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label_at(points[k]);
    counts_.primary += points.size();
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      labels[k] = label_at(requests[k].point);
      const std::uint64_t key = sampling::hash(requests[k].sequence, requests[k].index);
      values[k * static_cast<std::size_t>(stride())] = static_cast<float>(
          value_of(labels[k]) + sigma_ * std::sqrt(12.0) * (sampling::unit_double(key) - 0.5));
    }
    counts_.primary += requests.size();
  }
  std::uint32_t material_of(sampling::Label label) const override {
    return static_cast<std::uint32_t>(label % 2);
  }
  sampling::RayCounts counts() const override { return counts_; }

  double truth(int x, int y) const {
    constexpr int kSteps = 400;
    double sum = 0.0;
    for (int j = 0; j < kSteps; ++j)
      for (int i = 0; i < kSteps; ++i)
        sum += value_of(label_at({x + (i + 0.5) / kSteps, y + (j + 0.5) / kSteps}));
    return sum / (kSteps * kSteps);
  }

 private:
  sampling::Label label_at(sampling::FocalPoint p) const {
    const auto cell = [&](double x) { return static_cast<std::uint64_t>(std::floor(x / size_px_) + 1000.0); };
    return sampling::hash(seed_, cell(p.x_px + 0.21 * p.y_px), cell(p.y_px - 0.13 * p.x_px)) % 5 + 1;
  }
  double value_of(sampling::Label label) const { return 8.0 + static_cast<double>(label); }

  double size_px_, sigma_;
  std::uint64_t seed_;
  sampling::RayCounts counts_;
};

struct Outcome {
  double rays = 0.0, direct_rays = 0.0;
  int covered = 0, pixels = 0, agreeing = 0, counted = 0;
};

/// From twice the half-width to it, against from the start. Truth is that of plain pixels.
Outcome refine(double size_px, double sigma, double half_width, int trials,
               const sampling::PixelFootprint& footprint = sampling::PixelFootprint::box(1.0)) {
  Outcome outcome;
  for (int trial = 0; trial < trials; ++trial) {
    const auto seed = static_cast<std::uint64_t>(trial + 1);
    const FixedTolerance loose(2.0 * half_width), tight(half_width);
    const int steering_channels[1] = {0};
    sampling::TileProblem problem;
    problem.tile = problem.image = {0, 0, 4, 4};
    problem.seed = seed;
    problem.footprint = &footprint;
    problem.steering_channels = steering_channels;
    const sampling::AccuracySampler sampler;

    Patches field(size_px, sigma, seed), again(size_px, sigma, seed);
    sampling::TileResult first, refined, direct;
    problem.tolerance = &loose;
    problem.keep_memory = true;
    sampler.sample(problem, field, first);
    problem.tolerance = &tight;
    problem.before = &first;
    sampler.sample(problem, field, refined);
    problem.before = nullptr;
    problem.keep_memory = false;
    sampler.sample(problem, again, direct);

    outcome.rays += static_cast<double>(field.counts().total());
    outcome.direct_rays += static_cast<double>(again.counts().total());
    std::uint64_t reported = refined.halo_samples;
    for (const std::uint32_t samples : refined.samples) reported += samples;
    outcome.counted += reported == field.counts().primary;
    for (int p = 0; p < 16; ++p) {
      const auto i = static_cast<std::size_t>(p);
      const double truth = field.truth(p % 4, p / 4);
      outcome.covered += std::abs(refined.mean[i] - truth) <= refined.half_width[i] + 2e-4;
      outcome.agreeing += std::abs(refined.mean[i] - direct.mean[i]) <=
                          std::hypot(refined.half_width[i], direct.half_width[i]) + 1e-6;
      ++outcome.pixels;
      EXPECT_LE(refined.half_width[i], 1.001 * half_width);
    }
  }
  return outcome;
}

class Refine : public testing::TestWithParam<std::array<double, 3>> {};

TEST_P(Refine, CostsWhatTheTighterToleranceCostsAndHolds) {
  const auto [size_px, sigma, half_width] = GetParam();
  constexpr int kTrials = 12;
  const Outcome outcome = refine(size_px, sigma, half_width, kTrials);
  EXPECT_LE(outcome.rays, 1.15 * outcome.direct_rays);
  EXPECT_GE(outcome.covered, 0.93 * outcome.pixels);
  EXPECT_GE(outcome.agreeing, 0.95 * outcome.pixels);
  EXPECT_EQ(outcome.counted, kTrials) << "every ray of both runs is in the counts";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Refine,
                         testing::Values(std::array{2.3, 0.0, 0.02},    // borders alone
                                         std::array{2.3, 0.5, 0.05},    // noise within them
                                         std::array{0.17, 0.0, 0.1},    // clutter
                                         std::array{0.17, 0.5, 0.1}));  // noisy clutter

// Under a PSF values are kept with their places, of pixels beyond the tile too.
TEST(RefineUnderAPsf, GoesOnWhereItWas) {
  constexpr int kTrials = 6;
  const Outcome outcome = refine(2.3, 0.5, 0.05, kTrials, gaussian(0.6, 1.5));
  EXPECT_LE(outcome.rays, 1.15 * outcome.direct_rays);
  EXPECT_GE(outcome.agreeing, 0.95 * outcome.pixels);
  EXPECT_EQ(outcome.counted, kTrials);
}

/// Normal values, an end at `first` times the tolerance and then at the tolerance: share of the intervals
/// that hold. `remembered`: the second run's tests follow the first one's; else it takes its first test for
/// its only one.
double coverage(double first, bool remembered) {
  constexpr int kTrials = 6000, kReplicates = 12;
  constexpr double kNeeded = 200.0;
  const sampling::Stopping stopping(0.95);
  const double limit = 1.96 / std::sqrt(kNeeded);
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::uint64_t key = sampling::hash(77, trial);
    const auto normal = [&] {
      key = sampling::mix(key);
      const double u = sampling::unit_double(key), v = sampling::unit_double(sampling::mix(key + 1));
      return std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * std::numbers::pi * v);
    };
    std::vector<double> sum(kReplicates, 0.0);
    double drawn = 0.0, mean = 0.0, error = 0.0, half_width = 0.0;
    const auto grow = [&](double grown) {
      mean = 0.0;
      for (double& s : sum) mean += (s += std::sqrt(grown - drawn) * normal()) / grown / kReplicates;
      drawn = grown;
      double squares = 0.0;
      for (double s : sum) squares += (s / drawn - mean) * (s / drawn - mean);
      error = std::sqrt(squares / (kReplicates - 1.0) / kReplicates);
    };
    int tests = 2;
    grow(2.0);
    while ((half_width = stopping.student(tests, kReplicates - 1.0) * error) > first * limit) {
      grow(2.0 * drawn);
      ++tests;
    }
    const auto quantile = [&] {
      return remembered ? stopping.student(tests, kReplicates - 1.0)
                        : sampling::two_sided_student(0.95, kReplicates - 1);
    };
    while ((half_width = quantile() * error) > limit) {
      grow(2.0 * drawn);
      ++tests;
    }
    covered += std::abs(mean) <= half_width;
  }
  return covered / static_cast<double>(kTrials);
}

TEST(RefinedTests, IntervalsCountTheTestsOfBothRuns) {
  for (const double first : {4.0 / 3.0, 1.5, 2.0, 4.0}) EXPECT_GE(coverage(first, true), 0.945) << first;
}

TEST(RefinedTests, IntervalsThatForgetTheTestsFail) {
  for (const double first : {4.0 / 3.0, 2.0}) EXPECT_LT(coverage(first, false), 0.945) << first;
}

}  // namespace
}  // namespace ifov::test::test_refine
