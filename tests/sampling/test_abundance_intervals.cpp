// Half-widths of abundances: of borders that were traced, and of clutter.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "accuracy_scenes.h"

namespace ifov::test::test_abundance_intervals {
namespace {

using namespace sampling;

struct Judged {
  int count = 0, covered = 0;
  double half_width = 0.0, squares = 0.0;

  void add(double error, double half) {
    ++count;
    covered += std::abs(error) <= half + 1e-6;
    half_width += half;
    squares += error * error;
  }
  double coverage() const { return static_cast<double>(covered) / count; }
  double mean_half_width() const { return half_width / count; }
  double rms() const { return std::sqrt(squares / count); }
};

const Abundance* of(const TileResult& result, std::uint32_t pixel, std::uint32_t material) {
  for (const Abundance& a : result.abundances)
    if (a.pixel == pixel && a.material == material) return &a;
  return nullptr;
}

TEST(AbundanceIntervals, HoldWhereABorderWasTraced) {
  Judged judged;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Draw draw(seed);
    const double x = 1.4 + 0.2 * draw(), y = 1.4 + 0.2 * draw();
    const DiscScene scene{x, y, 0.3 + 0.2 * draw()};
    ShapeField field = scene.field();
    const TileResult result = three_by_three(seed)(field);
    for (const std::uint32_t material : {0u, 1u}) {
      const Abundance* a = of(result, 4, material);
      ASSERT_NE(a, nullptr);
      judged.add(a->fraction - (material == 1 ? scene.fraction() : 1.0 - scene.fraction()), a->half_width);
    }
  }
  EXPECT_GE(judged.coverage(), 0.93);
  EXPECT_LE(judged.mean_half_width(), 4.0 * judged.rms());
}

/// Tiles of 1/16 px of five materials at random: far more borders than are worth tracing.
std::uint32_t material_at(double x, double y) {
  const auto i = static_cast<std::int64_t>(std::floor(16.0 * x)),
             j = static_cast<std::int64_t>(std::floor(16.0 * y));
  return static_cast<std::uint32_t>(hash(77, i, j) % 5);
}

TEST(AbundanceIntervals, HoldInClutter) {
  constexpr int kSide = 6;
  ShapeField field(
      [](double x, double y) { return static_cast<Label>(material_at(x, y)); },
      [](Label l, double, double, int) { return static_cast<float>(kCold + 0.9 * static_cast<double>(l)); });
  Judged judged;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rendering render = three_by_three(seed);
    render.tile = render.image = {0, 0, kSide, kSide};
    render.half_width = 0.15;
    const TileResult result = render(field);
    for (std::uint32_t p = 0; p < kSide * kSide; ++p) {
      double truth[5] = {};
      for (int t = 0; t < 256; ++t)
        truth[material_at(p % kSide + (t % 16 + 0.5) / 16.0,
                          static_cast<double>(p / kSide) + (t / 16 + 0.5) / 16.0)] += 1.0 / 256.0;
      for (std::uint32_t m = 0; m < 5; ++m) {
        const Abundance* a = of(result, p, m);
        ASSERT_NE(a, nullptr);
        ASSERT_GT(a->half_width, 0.0f);
        judged.add(a->fraction - truth[m], a->half_width);
        // The shares of a pixel are those of its values: no wider than if these were drawn one by one.
        const double values = result.radiance_evaluations[p],
                     one_by_one = 1.96 * std::sqrt(a->fraction * (1.0 - a->fraction) / values);
        EXPECT_LT(a->half_width, 1.5 * one_by_one);
        EXPECT_GT(a->half_width, 0.9 * one_by_one);
      }
    }
  }
  EXPECT_GE(judged.coverage(), 0.95);
}

/// Pixels may err by 0.1 and by 0.4 more of what they hold of materials from 2 on, where that is asked.
class LooserByMaterial final : public Tolerance {
 public:
  explicit LooserByMaterial(bool asked) : asked_(asked) {}
  bool by_material() const override { return asked_; }
  void limits(std::span<const double>, std::span<double> limit) const override {
    std::fill(limit.begin(), limit.end(), 0.1);
  }
  void limits_holding(const Abundance* held, std::size_t count, std::span<const double>,
                      std::span<double> limit) const override {
    double loose = 0.0;
    for (std::size_t k = 0; k < count; ++k)
      if (held[k].material >= 2) loose += held[k].fraction;
    std::fill(limit.begin(), limit.end(), 0.1 + 0.4 * loose);
  }
  double confidence() const override { return 0.95; }

 private:
  bool asked_;
};

// What is less to be known of a pixel for the materials in it takes fewer rays, and no others' are fewer.
TEST(AbundanceIntervals, LimitsAreThoseOfTheMaterialsHeld) {
  constexpr int kSide = 6;
  const auto at = [](double x, double y) {  // clutter of 0 and 1 to the left, of 2 and 3 to the right
    return (x < 0.5 * kSide ? 0u : 2u) + material_at(x, y) % 2;
  };
  const auto samples = [&](bool asked) {
    ShapeField field([&](double x, double y) { return static_cast<Label>(at(x, y)); },
                     [](Label l, double, double, int) {
                       return static_cast<float>(kCold + 2.0 * static_cast<double>(l % 2));
                     });
    const LooserByMaterial tolerance(asked);
    const PixelFootprint footprint = PixelFootprint::box(1.0);
    const int steering_channels[1] = {0};
    TileProblem problem;
    problem.tile = problem.image = {0, 0, kSide, kSide};
    problem.seed = 3;
    problem.footprint = &footprint;
    problem.tolerance = &tolerance;
    problem.steering_channels = steering_channels;
    TileResult result;
    AccuracySampler(AccuracyOptions{}).sample(problem, field, result);
    std::array<double, 2> sums{};
    for (std::size_t p = 0; p < kSide * kSide; ++p) {
      EXPECT_TRUE(result.converged(p)) << p;
      const bool loose = p % kSide >= kSide / 2;
      sums[loose] += result.radiance_evaluations[p];
      EXPECT_LE(result.half_width[p], (asked && loose ? 0.5f : 0.1f) * 1.00001f);
    }
    return sums;
  };
  const auto told = samples(true), same = samples(false);
  EXPECT_LT(told[1], 0.4 * told[0]);
  EXPECT_NEAR(told[0] / same[0], 1.0, 0.05);
  EXPECT_GT(same[1], 0.7 * same[0]);  // a fault: limits of one for all
}

}  // namespace
}  // namespace ifov::test::test_abundance_intervals
