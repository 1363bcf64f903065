#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy_scenes.h"

// The shapes of study 2 on 3 x 3 pixels: errors of the centre pixel, counts over all nine. Fixed seeds;
// limits are the product's own with room for fewer trials.

namespace ifov::test {
namespace {

constexpr int kTrials = 200;

Trials discs(double error_k, int trials, std::uint64_t first_seed) {
  Trials t;
  for (int i = 0; i < trials; ++i) {
    Draw draw(first_seed + static_cast<std::uint64_t>(i));
    const DiscScene scene{1.5 + (draw() - 0.5) * 0.2, 1.5 + (draw() - 0.5) * 0.2, half_pixel_radius()};
    ShapeField field = scene.field();
    Rendering render = three_by_three(first_seed + static_cast<std::uint64_t>(i));
    render.half_width = error_k * kRadiancePerKelvin;
    t.add(render(field), scene.truth(), field);
  }
  return t;
}

TEST(AccuracyShapes, DiscToATenthOfAKelvin) {
  const Trials t = discs(0.1, kTrials, 1000);
  EXPECT_LE(t.mean_samples(), 200.0);  // of which 36 looks at random
  EXPECT_LE(t.quantile(0.95), 0.1 * kRadiancePerKelvin);
  EXPECT_GE(t.coverage(), 0.94);
  for (double h : t.half_width) EXPECT_LE(h, 0.1 * kRadiancePerKelvin * (1.0 + 1e-5));
}

TEST(AccuracyShapes, DiscToAHundredthOfAKelvin) {
  const Trials t = discs(0.01, kTrials, 5000);
  EXPECT_LE(t.mean_samples(), 250.0);
  EXPECT_LE(t.quantile(0.95), 0.01 * kRadiancePerKelvin);
  EXPECT_GE(t.coverage(), 0.94);
}

TEST(AccuracyShapes, TurnedSquare) {
  Trials t;
  for (int i = 0; i < kTrials; ++i) {
    Draw draw(2000 + static_cast<std::uint64_t>(i));
    const double x = 1.5 + (draw() - 0.5) * 0.3, y = 1.5 + (draw() - 0.5) * 0.3, side = std::sqrt(0.5);
    const PolygonScene scene{turned_rectangle(x, y, side, side, draw() * std::numbers::pi)};
    ShapeField field = scene.field();
    t.add(three_by_three(2000 + static_cast<std::uint64_t>(i))(field), scene.truth(), field);
  }
  EXPECT_LE(t.mean_samples(), 600.0);
  EXPECT_LE(t.quantile(0.95), 0.1 * kRadiancePerKelvin);
  EXPECT_GE(t.coverage(), 0.93);
}

Trials rods(bool seeded) {
  Trials t;
  for (int i = 0; i < kTrials; ++i) {
    Draw draw(3000 + static_cast<std::uint64_t>(i));
    const double x = 1 + draw(), y = 1 + draw(), width = 0.02 + 0.03 * draw(), length = 1 + draw();
    const double angle = draw() * std::numbers::pi;
    const PolygonScene scene{turned_rectangle(x, y, width, length, angle)};
    ShapeField field = scene.field();
    Rendering render = three_by_three(3000 + static_cast<std::uint64_t>(i));
    const int pieces = static_cast<int>(std::ceil(length / 0.35));
    for (int p = 0; p < pieces && seeded; ++p) {
      const double s = ((p + 0.5) / pieces - 0.5) * length;
      const sampling::FocalPoint at{x + std::cos(angle) * s, y + std::sin(angle) * s};
      if (at.x_px > 0 && at.y_px > 0 && at.x_px < 3 && at.y_px < 3) render.seeds.push_back(at);
    }
    t.add(render(field), scene.truth(), field);
  }
  return t;
}

TEST(AccuracyShapes, SeededRodsAreFollowed) {
  const Trials t = rods(true);
  EXPECT_LE(t.mean_samples(), 1700.0);  // narrow things make pixels look for more of them
  EXPECT_LE(t.quantile(0.95), 0.1 * kRadiancePerKelvin);
  EXPECT_GE(t.coverage(), 0.93);
}

TEST(AccuracyShapes, RodsWithoutSeedsAreMissedSometimes) {
  EXPECT_GT(rods(false).quantile(0.95), 0.1 * kRadiancePerKelvin);
}

Trials small_targets(bool seeded) {
  Trials t;
  for (int i = 0; i < kTrials; ++i) {
    Draw draw(4000 + static_cast<std::uint64_t>(i));
    const double r = std::sqrt(0.005 / std::numbers::pi);
    const DiscScene scene{1 + r + draw() * (1 - 2 * r), 1 + r + draw() * (1 - 2 * r), r};
    ShapeField field = scene.field();
    Rendering render = three_by_three(4000 + static_cast<std::uint64_t>(i));
    render.options.lattice = 2;
    if (seeded) render.seeds.push_back({scene.x, scene.y});
    t.add(render(field), scene.truth(), field);
  }
  return t;
}

TEST(AccuracyShapes, SmallTargetWithASeedIsAlwaysFound) {
  const Trials t = small_targets(true);
  EXPECT_EQ(t.found, kTrials);
  EXPECT_LE(t.mean_samples(), 25.0 * 9.0);
  EXPECT_GE(t.coverage(), 0.90);
}

TEST(AccuracyShapes, SmallTargetWithoutASeedIsMissed) { EXPECT_LT(small_targets(false).found, kTrials / 2); }

// Random rays have a probability, the lattice has none.
TEST(AccuracyShapes, DetectionStatementRestsOnRandomLooks) {
  ShapeField field = two_surfaces([](double, double) { return sampling::Label{0}; });
  const sampling::TileResult r = three_by_three(1)(field);
  EXPECT_NEAR(r.missable_fraction[4], 0.446, 0.002);  // of four jittered rays, as in test_detection
  EXPECT_EQ(field.counts().primary, 136u);  // the lattice, and four looks in each of the nine pixels
  for (float h : r.half_width) EXPECT_EQ(h, 0.0f);
  for (auto reasons : r.reasons) EXPECT_EQ(reasons, 0);
}

// An exactly centred disc: every crossing sees the lattice alike, so that undithered brackets err alike and
// the interval is wrong every time.
TEST(AccuracyShapes, UnditheredBracketsFailOnAnAlignedScene) {
  const auto coverage = [](bool undithered) {
    int covered = 0, count = 0;
    for (double r = 0.36; r < 0.44; r += 0.0005) {
      const DiscScene scene{1.5, 1.5, r};
      ShapeField field = scene.field();
      Rendering render = three_by_three(static_cast<std::uint64_t>(r * 1e6));
      render.faults.undithered_brackets = undithered;
      const sampling::TileResult result = render(field);
      covered += std::abs(result.mean[4] - scene.truth()) <= result.half_width[4] + 1e-6;
      ++count;
    }
    return covered / static_cast<double>(count);
  };
  const double dithered = coverage(false), undithered = coverage(true);
  EXPECT_GE(dithered, 0.94);
  EXPECT_LT(undithered, 0.80);
}

TEST(AccuracyShapes, AbundancesAreAreasWithIntervals) {
  int covered = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Draw draw(7000 + i);
    const DiscScene scene{1.5 + (draw() - 0.5) * 0.2, 1.5 + (draw() - 0.5) * 0.2, half_pixel_radius()};
    ShapeField field = scene.field();
    const sampling::TileResult r = three_by_three(7000 + i)(field);
    double sum = 0.0;
    for (const sampling::Abundance& a : r.abundances)
      if (a.pixel == 4) {
        sum += a.fraction;
        if (a.material == 1) covered += std::abs(a.fraction - scene.fraction()) <= a.half_width;
      }
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
  EXPECT_GE(covered, 93);
}

}  // namespace
}  // namespace ifov::test
