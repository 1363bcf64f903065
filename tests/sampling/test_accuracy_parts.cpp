#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy_scenes.h"
#include "core/error.h"
#include "core/run_control.h"
#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/flat_map.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/basis/small_vector.h"
#include "sampling/accuracy/borders/bracket.h"
#include "sampling/accuracy/borders/chord.h"
#include "sampling/accuracy/borders/clutter.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/weights/pixel_model.h"

namespace ifov::sampling::test_accuracy_parts {
namespace {

Bracket bisected(double crossing_px, double length_px, double target_px, std::uint64_t key, bool dither) {
  Bracket b;
  b.first = 0;
  b.last = 1;
  b.length_px = length_px;
  b.lay_grid(target_px, dither ? Dither().phase(key) : 0.5);
  while (b.on_grid()) b.take(b.next() < crossing_px ? 0 : 1);
  return b;
}

TEST(Bracket, HoldsTheCrossingAndIsAsNarrowAsAsked) {
  for (std::uint64_t key = 0; key < 200; ++key) {
    const double at = unit_double(mix(key + 77)) / 3.0;
    Bracket b = bisected(at, 1.0 / 3.0, 0.04, key, true);
    EXPECT_LE(b.low, at);
    EXPECT_GE(b.high, at);
    EXPECT_LE(b.width(), 0.06);
    const double before = b.width();
    b.take(b.next() < at ? 0 : 1);
    EXPECT_NEAR(b.width(), 0.5 * before, 1e-12);
  }
}

// The centre of a dithered bracket errs uniformly about a crossing away from the edge's ends; without the
// dither the error is the same every time.
TEST(Bracket, DitherMakesTheErrorOfItsCentreUniform) {
  const double at = 0.171, length = 1.0 / 3.0;
  double sum = 0.0, squares = 0.0, step = 0.0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const Bracket b = bisected(at, length, 0.04, static_cast<std::uint64_t>(i), true);
    const double e = b.centre() - at;
    sum += e;
    squares += e * e;
    step = b.step;
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 * step / std::sqrt(12.0 * n));
  EXPECT_NEAR(squares / n, step * step / 12.0, 0.05 * step * step / 12.0);
  const Bracket plain = bisected(at, length, 0.04, 1, false), again = bisected(at, length, 0.04, 2, false);
  EXPECT_EQ(plain.centre(), again.centre());
}

// Wherever on its edge a crossing is: the grid goes on beyond the ends. What lies on the edge of a bracket alone would err
// to one side, alike in all pixels of an aligned scene.
TEST(Bracket, HasNoBiasNearTheEndsOfItsEdge) {
  const double length = 1.0 / 3.0;
  const int n = 4000;
  for (const double target : {0.02, 0.2})
    for (const double at : {0.0004, 0.004, 0.03, 0.16, length - 0.002})
      for (const int halvings : {0, 1, 3}) {
        double error = 0.0, drawn = 0.0, width = 0.0;
        for (int i = 0; i < n; ++i) {
          Bracket b = bisected(at, length, target, static_cast<std::uint64_t>(i), true);
          for (int h = 0; h < halvings; ++h)
            if (!b.skip_known()) b.take(b.next() < at ? 0 : 1);
          error += (b.centre() + b.excess() - at) / n;
          drawn += (b.centre() - at) / n;
          width = b.width();
          EXPECT_GE(b.centre(), 0.0);
          EXPECT_LE(b.centre(), length);
        }
        EXPECT_NEAR(error, 0.0, 4.0 * width / std::sqrt(12.0 * n)) << at << " " << target << " " << halvings;
        if (at < 0.1 * width) {
          EXPECT_GT(drawn, 0.05 * width) << "a planted fault: without the excess";
        }
      }
}

TEST(Bracket, NoticesAThirdLabel) {
  Bracket b;
  b.first = 0;
  b.last = 1;
  b.length_px = 1.0;
  b.lay_grid(0.1, Dither().phase(5));
  b.take(2);
  EXPECT_TRUE(b.third_label);
}

TEST(Chord, SegmentAreaIsTheCircles) {
  // A half disc of radius 1: chord 2, sagitta 1. A shallow arc: 2/3 c s.
  EXPECT_NEAR(circular_segment_area(2.0, 1.0), 0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(circular_segment_area(1.0, 1e-4), 2.0 / 3.0 * 1e-4, 1e-10);
}

TEST(Chord, KnotsEncloseTheSegment) {
  const Point2 a{0.2, 0.1}, b{0.5, 0.4};
  for (double s : {-0.05, 0.02, 0.08}) {
    Point2 knots[3];
    arc_knots(a, b, s, knots);
    Polygon p;
    p.add(a);
    for (const Point2& k : knots) p.add(k);
    p.add(b);
    EXPECT_NEAR(std::abs(p.signed_area()), circular_segment_area(length(b - a), s), 1e-12);
  }
}

TEST(Chord, CurvatureOfThreePointsPredictsTheSagitta) {
  const double r = 0.4;
  const auto on = [&](double angle) { return Point2{r * std::cos(angle), r * std::sin(angle)}; };
  const Point2 p = on(0.1), q = on(0.9), m = on(1.35), e = on(1.8);
  const double curvature = menger_curvature(p, q, e, length(q - p), length(e - q)), c = length(e - q);
  EXPECT_NEAR(std::abs(curvature), 1.0 / r, 1e-12);
  const Point2 d = e - q, normal{-d.y / c, d.x / c},
               top = 0.5 * (q + e) + sagitta_of_curvature(curvature, c) * normal;
  EXPECT_NEAR(length(top - m), 0.0, 1e-12);
}

// What is added to a pixel anew starts from nothing.
TEST(PixelModel, PartsThatWereForgottenLeaveNoWeights) {
  PixelModel model;
  model.outputs.push_back(0);
  model.outputs.push_back(1);
  const auto add = [&] {
    model.add_region(4);
    model.add_border(4, 5);
    model.add_loose_pair(4, 5);
  };
  add();
  model.area[0] = 0.5;
  for (std::size_t o = 0; o < 2; ++o)
    model.weight[o] = model.border_variance[o] = model.loose_weight[o] = 0.25;
  model.forget_parts();
  EXPECT_EQ(model.outputs.size(), 2u);
  add();
  EXPECT_EQ(model.area[0], 0.0);
  for (std::size_t o = 0; o < 2; ++o) {
    EXPECT_EQ(model.weight_of(0, o, 0), 0.0);
    EXPECT_EQ(model.border_variance_of(0, o, 0), 0.0);
    EXPECT_EQ(model.loose_weight_of(0, o, 0), 0.0);
  }
  EXPECT_EQ(model.loose_weight.size(), 2u);
}

// Every kind of question checks whether the work was cancelled before it traces anything.
TEST(RayLedger, EveryQuestionEndsWhenCancelled) {
  test::ShapeField field = test::uniform_field(1.0f);
  CancelToken cancel;
  TileProblem problem;
  problem.cancel = &cancel;
  const Lattice lattice({0, 0, 2, 2}, 3);
  LabelTable table(1);
  RayLedger ledger(field, &cancel, lattice, table, nullptr);
  const FocalPoint point{0.5, 0.5};
  const PathRequest request{point, 1, 0};
  std::vector<std::uint32_t> out;
  std::vector<float> values(static_cast<std::size_t>(field.stride()));
  const auto ask_all = [&](const auto& check) {
    check([&] { ledger.labels({&point, 1}, out, Purpose::trace); });
    check([&] { ledger.values({&request, 1}, out, values); });
    check([&] { ledger.first_values({&request, 1}, out, values); });
    check([&] { ledger.values_and_materials({&request, 1}, out, values); });
  };
  ask_all([](const auto& ask) { EXPECT_NO_THROW(ask()); });
  const std::uint64_t before = field.counts().total();
  EXPECT_EQ(before, 4u);
  cancel.cancel();
  ask_all([](const auto& ask) { EXPECT_THROW(ask(), Cancelled); });
  EXPECT_EQ(field.counts().total(), before);
}

TEST(Polygon, ClipsToTheSameAreaAsTheIntegral) {
  const Polygon p = test::turned_rectangle(0.4, 0.6, 0.5, 0.9, 0.7);
  double inside = 0.0;
  const int n = 400;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) inside += p.contains({(i + 0.5) / n, (j + 0.5) / n});
  EXPECT_NEAR(test::polygon_in_rectangle(p, 0, 0, 1, 1), inside / (n * n), 1e-3);
  EXPECT_NEAR(std::abs(p.signed_area()), 0.45, 1e-12);
}

TEST(Lattice, NeighbouringTilesAgreeAboutAVertex) {
  const Lattice left({0, 0, 20, 16}, 3), right({13, -2, 40, 16}, 3);
  const std::int32_t units = 3 << kMaxLevel;
  for (std::int32_t f : {0, 1, 511, 512, 777, 1535, 4000}) {
    const FocalPoint a = left.point(15 * units + f, 3 * units + f),
                     b = right.point(2 * units + f, 5 * units + f);
    EXPECT_EQ(a.x_px, b.x_px);
    EXPECT_EQ(a.y_px, b.y_px);
    EXPECT_EQ(left.image_x(15 * units + f), right.image_x(2 * units + f));
    EXPECT_EQ(left.image_y(3 * units + f), right.image_y(5 * units + f));
  }
}

TEST(Chord, TheSeriesOfShallowArcsMeetsTheClosedForm) {
  for (double t : {0.02, 0.0999, 0.1001, 0.5, 1.0}) {
    const double angle = 2.0 * std::atan(t), radius = (0.25 + 0.25 * t * t) / t;
    EXPECT_NEAR(
        circular_segment_area(1.0, 0.5 * t) / (radius * radius * (angle - std::sin(angle) * std::cos(angle))),
        1.0, 1e-9);
    EXPECT_NEAR(atan_over_argument(t), std::atan(t) / t, 3e-4);
  }
}

TEST(Lattice, PixelsOfCellsComeFromAnExactDivision) {
  for (int k = 1; k <= 32; ++k) {
    const Lattice lattice({5, -3, 205, 197}, k);
    for (int x = 0; x < 200 * k; ++x)
      ASSERT_EQ(lattice.pixel_of_cell(x * Lattice::side(0), 0), x / k)
          << "column " << x << " of " << k << " a pixel";
    EXPECT_EQ(lattice.x_px(7 * k * Lattice::side(0)), 12.0);
  }
}

TEST(SmallVector, GrowsBeyondItsOwnPlaces) {
  SmallVector<int, 2> v;
  for (int i = 0; i < 5; ++i) v.push_back(i);
  const SmallVector<int, 2> copy = v;
  ASSERT_EQ(copy.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(copy[static_cast<std::size_t>(i)], i);
  v.clear();
  EXPECT_TRUE(v.empty());
  v.push_back(7);
  v.assign(2, 9);
  EXPECT_EQ(v.size(), 2u);
  EXPECT_EQ(v[1], 9);
}

TEST(FlatMap, FindsWhatWasPutIn) {
  FlatMap map;
  for (std::uint32_t i = 0; i < 5000; ++i) EXPECT_EQ(map.find_or_insert(i * 7919ull, i), i);
  for (std::uint32_t i = 0; i < 5000; ++i) EXPECT_EQ(map.find(i * 7919ull), i);
  EXPECT_EQ(map.find(3), FlatMap::kAbsent);
  EXPECT_EQ(map.size(), 5000u);
}

TEST(LabelTable, SameValuesTogetherMeanWhatTheyMeanOneByOne) {
  LabelTable table(1);
  const std::uint32_t one = table.index(7), other = table.index(8);
  const std::vector<float> value{0.3f};
  for (int k = 0; k < 9; ++k) table.add(one, value.data());
  table.add_same(other, value.data(), 4);
  table.add_same(other, value.data(), 0);
  table.add_same(other, value.data(), 5);
  EXPECT_EQ(table.count(one), table.count(other));
  EXPECT_EQ(*table.mean(one), *table.mean(other));
}

TEST(LabelSpread, IsZeroOnlyWhereAllValuesAgree) {
  const Lattice lattice({0, 0, 2, 2}, 2);
  LabelTable table(1);
  LatticeValues at;
  at.columns = 1;
  at.labels.resize(25);
  for (std::size_t v = 0; v < 25; ++v) {
    at.labels[v] = table.index(v % 5 < 3 ? 10 : 20);
    at.values.push_back(v % 5 < 3 ? 1.0f : 2.0f);
    table.add(at.labels[v], at.value(v));
  }
  for (const bool known : {false, true}) {  // that the values agree
    at.constant.assign(2, known);
    const LabelSpread equal(lattice, table, at);
    EXPECT_EQ(equal.local(0, 0), 0.0);
    EXPECT_EQ(equal.total(1, 0), 0.0);
    EXPECT_EQ(equal.blocks(0), 8.0);
  }
  at.values[0] = 1.5f;  // one value of one label disagrees: no label is certain any more
  at.constant[0] = 0;
  const LabelSpread unequal(lattice, table, at);
  EXPECT_GT(unequal.local(0, 0), 0.0);
  EXPECT_GT(unequal.local(1, 0), 0.0);
  EXPECT_GT(unequal.local(99, 0), 0.0);  // a label found later
}

// On a plane of radiance the local spread is zero, the total one is not.
TEST(LabelSpread, LocalIsBlindToAPlane) {
  const Lattice lattice({0, 0, 3, 3}, 2);
  LabelTable table(1);
  LatticeValues at;
  at.columns = 1;
  at.constant.assign(1, 0);
  for (std::size_t v = 0; v < 49; ++v) {
    at.labels.push_back(table.index(1));
    at.values.push_back(
        static_cast<float>(0.5 * static_cast<double>(v % 7) + 0.25 * static_cast<double>(v / 7)));
    table.add(0, at.value(v));
  }
  const LabelSpread spread(lattice, table, at);
  EXPECT_NEAR(spread.local(0, 0), 0.0, 1e-12);
  EXPECT_GT(spread.total(0, 0), 0.5);
}

/// A chequered label beside a level one: what the level one may vary by comes from the other alone, at the weight of two
/// values, and one without blocks of its own has what all have.
TEST(LabelSpread, ALabelBorrowsTwoValuesFromAllLabels) {
  constexpr int kSide = 6, kRow = kSide + 1;
  const Lattice lattice({0, 0, 3, 3}, 2);
  LabelTable table(1);
  LatticeValues at;
  at.columns = 1;
  at.constant.assign(2, 0);
  for (int v = 0; v < kRow * kRow; ++v) {
    const int i = v % kRow, j = v / kRow;
    at.labels.push_back(table.index(i < 3 ? 10 : 20));
    at.values.push_back(i < 3 ? ((i + j) % 2 == 0 ? 1.0f : -1.0f) : 0.0f);
    table.add(at.labels.back(), &at.values.back());
  }
  const LabelSpread spread(lattice, table, at);
  const double chequered = 2.0 * kSide, level = 3.0 * kSide, all = 4.0 * chequered / (chequered + level);
  EXPECT_EQ(spread.blocks(0), chequered);
  EXPECT_EQ(spread.blocks(1), level);
  EXPECT_NEAR(spread.local(99, 0), all, 1e-12);
  EXPECT_NEAR(spread.local(0, 0), (4.0 * chequered + 2.0 * all) / (chequered + 2.0), 1e-12);
  EXPECT_NEAR(spread.local(1, 0), 2.0 * all / (level + 2.0), 1e-12);
}

/// Noise of a known variance, whoever tells it: a label's own blocks, those of all, or looks beside the lattice.
TEST(LabelSpread, ToldVariancesAreThoseOfTheNoise) {
  constexpr int kRow = 61;
  const Lattice lattice({0, 0, 30, 30}, 2);
  LabelTable table(1);
  LatticeValues at;
  at.columns = 1;
  at.constant.assign(2, 0);
  const auto noise = [](int k) {
    return static_cast<float>(unit_double(mix(static_cast<std::uint64_t>(k) + 31)));
  };
  for (int v = 0; v < kRow * kRow; ++v) {
    at.labels.push_back(table.index(v == 0 ? 10 : 20));  // the one label has a single value
    at.values.push_back(noise(v));
    table.add(at.labels.back(), &at.values.back());
  }
  for (const bool with_random_points : {false, true}) {
    for (int k = 0; with_random_points && k < 3600; ++k) {
      at.random.points.push_back({k % 60 * 0.5 + 0.25, k / 60 * 0.5 + 0.25});
      at.random.labels.push_back(1);
      at.random.values.push_back(noise(10000 + k));
      table.add(1, &at.random.values.back());
    }
    const LabelSpread spread(lattice, table, at);
    for (const std::uint32_t label : {0u, 1u, 99u})
      EXPECT_NEAR(spread.local(label, 0), 1.0 / 12.0, 0.1 / 12.0) << with_random_points;
    EXPECT_NEAR(spread.total(1, 0), 1.0 / 12.0, 0.05 / 12.0);
  }
}

TEST(Clutter, StratifiedCostFollowsItsErrorLaw) {
  const double n = stratified_cost(50.0, 4.0);
  EXPECT_NEAR(0.46 * 50.0 * std::sqrt(4.0) * std::pow(n, -0.75), 1.0, 1e-12);
}

}  // namespace
}  // namespace ifov::sampling::test_accuracy_parts
