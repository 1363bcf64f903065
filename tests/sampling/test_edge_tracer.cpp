#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/contradictions.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "shape_field.h"

namespace ifov::sampling::test_edge_tracer {
namespace {

/// The borders of a field over 3 x 3 pixels, of which each may err by `allowed` of the radiance that labels differ by.
struct Traced {
  explicit Traced(test::ShapeField field_traced, double allowed = 1e-3) : field(std::move(field_traced)) {
    contrast.begin(9);
    for (int p = 0; p < 9; ++p) contrast.allowed(p)[0] = allowed;
    std::vector<FocalPoint> points;
    std::vector<std::uint32_t> labels;
    for (int j = 0; j <= lattice.rows(); ++j)
      for (int i = 0; i <= lattice.columns(); ++i)
        points.push_back(lattice.point(i * Lattice::side(0), j * Lattice::side(0)));
    tracer.ask_at(points, labels, Purpose::trace);
    tracer.plant(labels);
    tracer.settle();
  }

  const std::vector<int> kSteering{0};
  test::ShapeField field;
  Lattice lattice{{0, 0, 3, 3}, 3};
  LabelTable table{1};
  RayLedger ledger{field, nullptr, lattice, table, nullptr};
  Contrast contrast{table, kSteering};
  AccuracyOptions options;
  Dither dither;
  EdgeTracer tracer{lattice, ledger, table, contrast, options, dither, 5};
};

TEST(EdgeTracer, ModelHasTheLabelsOfADiscBesideItsBorder) {
  Traced traced(test::disc_field(1.45, 1.55, 0.8));
  const BorderModel& model = traced.tracer.model();
  double inside = 0.0;
  const int n = 300;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = 3.0 * (i + 0.5) / n, y = 3.0 * (j + 0.5) / n, r = std::hypot(x - 1.45, y - 1.55);
      const std::uint32_t label = model.label_at({x, y});
      if (label == kNoLabel) continue;
      const double seen = static_cast<double>(traced.table.label(label));
      inside += seen * 9.0 / (n * n);
      if (std::abs(r - 0.8) > 0.01) {
        EXPECT_EQ(seen, r < 0.8 ? 1.0 : 0.0) << x << ", " << y;
      }
    }
  EXPECT_NEAR(inside, std::numbers::pi * 0.64, 5e-3);
  EXPECT_FALSE(traced.tracer.pixels().suspect(0));
}

TEST(EdgeTracer, WhatContradictsTheModelIsTakenIn) {
  // A spot between the vertices of the lattice.
  Traced traced(test::disc_field(1.5, 1.5, 0.1));
  EdgeTracer& tracer = traced.tracer;
  const FocalPoint middle{1.5, 1.5};
  ASSERT_EQ(traced.table.label(tracer.model().label_at(middle)), 0u) << "not met yet";
  std::vector<std::uint32_t> labels;
  tracer.ask_at({middle}, labels, Purpose::probe);
  EXPECT_TRUE(tracer.contradictions().disagrees(middle, labels[0], 0.0));
  for (int round = 0; round < 20 && tracer.contradict(middle, labels[0]); ++round) tracer.settle();
  EXPECT_EQ(tracer.model().label_at(middle), labels[0]);
  EXPECT_FALSE(tracer.contradictions().disagrees(middle, labels[0], 0.0));
  EXPECT_TRUE(tracer.pixels().suspect(4));
  EXPECT_FALSE(tracer.contradict(middle, labels[0])) << "it agrees";
}

TEST(Contradictions, BesideABorderTheBracketsAllowForThem) {
  Traced traced(test::ShapeField([](double x, double) { return static_cast<Label>(x < 1.45); },
                                 [](Label label, double, double, int) { return static_cast<float>(label); }),
                0.05);
  const Contradictions& judge = traced.tracer.contradictions();
  const std::uint32_t left = traced.tracer.model().label_at({1.0, 1.5}),
                      right = traced.tracer.model().label_at({2.0, 1.5});
  ASSERT_NE(left, right);
  EXPECT_TRUE(judge.disagrees({1.34, 1.5}, right, 0.0));
  EXPECT_FALSE(judge.disagrees({1.34, 1.5}, right, 0.2)) << "within the slack";
  EXPECT_FALSE(judge.disagrees({1.34, 1.5}, left, 0.0));
  EXPECT_GT(judge.dismissed({1.34, 1.5}, right), 0.0);
  EXPECT_EQ(judge.dismissed({1.34, 1.5}, left), 0.0);
  EXPECT_TRUE(judge.matters(4, left, right));
  EXPECT_FALSE(judge.matters(4, left, left));
}

TEST(EdgeTracer, PixelsBeyondTheirBudgetCostNoMoreRays) {
  const auto stripes = [] {
    return test::ShapeField(
        [](double x, double y) {
          return static_cast<Label>(std::floor(7.3 * x + 1.7 * y) + 40.0 * std::floor(6.1 * y - 2.3 * x)) &
                 1023;
        },
        [](Label label, double, double, int) { return static_cast<float>(label % 7); });
  };
  Traced traced(stripes(), 1e-3);
  for (std::uint32_t p = 0; p < 9; ++p) {
    if (traced.tracer.pixels().abandoned(p)) {
      EXPECT_GT(traced.ledger.label_rays()[p], traced.options.tracing_budget);
    }
  }
  EXPECT_TRUE(traced.tracer.pixels().abandoned(4)) << "of that many borders the tolerance asks for more";
}

}  // namespace
}  // namespace ifov::sampling::test_edge_tracer
