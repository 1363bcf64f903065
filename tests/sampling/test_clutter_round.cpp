#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "sampling/accuracy/weights/clutter_grid.h"
#include "sampling/accuracy/weights/clutter_round.h"
#include "sampling/field.h"
#include "sampling/hash.h"
#include "sampling/pixel_footprint.h"

namespace ifov::sampling::test_clutter_round {
namespace {

constexpr std::size_t kStride = 16;

/// A round over pixel (2, 3) of a picture, whose value may depend on a key that is different for every path.
ClutterRound filled(int side, std::uint64_t key, bool keep,
                    const std::function<double(double x, double y, std::uint64_t path)>& picture,
                    double* by_blocks = nullptr, double* by_steps = nullptr) {
  std::vector<double> cells(static_cast<std::size_t>(side * side));
  ClutterRound round(GridSides::square(side), kStride, keep);
  for (std::uint32_t block = 0; block < round.blocks(); ++block) {
    std::vector<PathRequest> requests;
    round.request(2, 3, key, {key, 0}, block, requests);
    std::vector<float> values(ClutterRound::kBlock * kStride, 0.0f);
    for (std::size_t q = 0; q < requests.size(); ++q)
      values[q * kStride] =
          static_cast<float>(picture(requests[q].point.x_px - 2.0, requests[q].point.y_px - 3.0,
                                     hash(requests[q].sequence, requests[q].index)));
    const std::uint32_t materials[4] = {7, 7, 7, 8};
    const double twist =
        static_cast<double>(values[0]) - values[kStride] - values[2 * kStride] + values[3 * kStride];
    if (by_blocks != nullptr) *by_blocks += twist * twist / std::pow(side, 4);
    for (std::size_t q = 0; q < requests.size(); ++q) {
      const int i = static_cast<int>((requests[q].point.x_px - 2.0) * side),
                j = static_cast<int>((requests[q].point.y_px - 3.0) * side);
      cells[static_cast<std::size_t>(j * side + i)] = static_cast<double>(values[q * kStride]);
    }
    round.add_block(values.data(), materials,
                    std::span<const PathRequest>(requests).first<ClutterRound::kBlock>());
  }
  for (int j = 0; by_steps != nullptr && j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const auto at = [&](int column, int row) {
        return cells[static_cast<std::size_t>(row * side + column)];
      };
      if (i + 1 < side) *by_steps += std::pow(at(i + 1, j) - at(i, j), 2) / 8.0 / std::pow(side, 4);
      if (j + 1 < side) *by_steps += std::pow(at(i, j + 1) - at(i, j), 2) / 8.0 / std::pow(side, 4);
    }
  return round;
}

struct Spread {
  double true_variance = 0.0, estimated = 0.0, as_if_independent = 0.0;
};

Spread spread(int side, const std::function<double(double, double, std::uint64_t)>& picture) {
  constexpr int kTrials = 2000;
  double sum = 0.0, squares = 0.0;
  Spread s;
  for (int k = 0; k < kTrials; ++k) {
    const ClutterRound round = filled(side, hash(5, k), false, picture);
    const ClutterRound::Moment m = round.moment(0);
    sum += m.mean;
    squares += m.mean * m.mean;
    s.estimated += m.variance / kTrials;
    s.as_if_independent += round.spread(0) / static_cast<double>(round.count()) / kTrials;
  }
  s.true_variance = squares / kTrials - sum * sum / kTrials / kTrials;
  return s;
}

TEST(ClutterRound, NoiseHasTheVarianceOfItsMean) {
  const Spread s = spread(8, [](double, double, std::uint64_t path) { return unit_double(path); });
  EXPECT_NEAR(s.true_variance, 1.0 / 12.0 / 64.0, 0.1 / 12.0 / 64.0);
  EXPECT_NEAR(s.estimated, s.true_variance, 0.1 * s.true_variance);
}

/// A border: blocks see 1.3 to 1.5 times its variance, values taken for independent many times.
TEST(ClutterRound, ABorderCostsLessThanIndependentValuesWould) {
  const Spread s =
      spread(10, [](double x, double y, std::uint64_t) { return 0.8 * x + 0.6 * y > 0.65 ? 1.0 : 0.0; });
  EXPECT_GT(s.estimated, 0.95 * s.true_variance);
  EXPECT_LT(s.estimated, 2.0 * s.true_variance);
  EXPECT_GT(s.as_if_independent, 5.0 * s.true_variance);
}

/// Share of the rounds whose mean is more than five of their standard errors off: a faint noise, and a line of a tenth of
/// the pixel, on which the points of a column of cells may all lie by chance.
double gross_errors(bool neighbours_tell) {
  constexpr int kTrials = 4000;
  constexpr double kLeft = 0.54, kRight = 0.64;
  const auto on_line = [](double x) { return x > kLeft && x < kRight; };
  int gross = 0;
  for (int k = 0; k < kTrials; ++k) {
    double by_blocks = 0.0;
    const ClutterRound round = filled(
        6, hash(6, k), false,
        [&](double x, double, std::uint64_t path) {
          return (on_line(x) ? 1.0 : 0.0) + 0.02 * unit_double(path);
        },
        &by_blocks);
    const ClutterRound::Moment m = round.moment(0);
    const double variance = neighbours_tell ? m.variance : by_blocks;
    if (std::abs(m.mean - (kRight - kLeft) - 0.01) > 5.0 * std::sqrt(variance)) ++gross;
  }
  return static_cast<double>(gross) / kTrials;
}

TEST(ClutterRound, PointsOnOneSideOfABorderDoNotMakeItExact) {
  EXPECT_LT(gross_errors(true), 0.01);
  EXPECT_GT(gross_errors(false), 0.04) << "blocks alone see nothing of it";
}

/// Over straight borders anywhere, the steps between neighbours add up to the variance: each costs 1/8 of its square.
TEST(ClutterRound, UnlikeNeighboursTellTheVarianceOfStraightBorders) {
  constexpr int kBorders = 1500;
  for (const int side : {6, 10, 20}) {
    double variance = 0.0, steps = 0.0;
    int more = 0;
    for (int k = 0; k < kBorders; ++k) {
      const double angle = 6.283185307179586 * unit_double(hash(8, k, 0)),
                   offset = 0.7 * (unit_double(hash(8, k, 1)) - 0.5);
      const double x = std::cos(angle), y = std::sin(angle);
      double mean[2];
      for (int twin = 0; twin < 2; ++twin) {
        double by_blocks = 0.0, by_steps = 0.0;
        const ClutterRound round = filled(
            side, hash(9, k, twin), false,
            [&](double px, double py, std::uint64_t) {
              return (px - 0.5) * x + (py - 0.5) * y > offset ? 1.0 : 0.0;
            },
            &by_blocks, &by_steps);
        mean[twin] = round.moment(0).mean;
        steps += 0.5 * by_steps;
        more += by_steps > by_blocks;
        EXPECT_NEAR(round.moment(0).variance, std::max(by_blocks, by_steps), 1e-12);
      }
      variance += 0.5 * (mean[0] - mean[1]) * (mean[0] - mean[1]);
    }
    EXPECT_GT(steps, 0.85 * variance) << side;
    EXPECT_LT(steps, 1.1 * variance) << side;
    EXPECT_GT(more, 0.02 * kBorders) << "blocks alone see too little there";
  }
}

/// As the weighted moments do where all weights are alike.
TEST(ClutterRound, BordersCountUnderAFootprintAsWell) {
  const auto picture = [](double x, double, std::uint64_t) {
    return x > 0.5 ? 1.0 : 0.0;
  };  // between two columns
  const ClutterRound round = filled(6, 12, true, picture);
  const std::vector<double> weights = round.weigh(PixelFootprint::box(4.0), {2.5, 3.5});
  EXPECT_NEAR(round.moment(0).variance, 6.0 / 8.0 / 36.0 / 36.0, 1e-12);
  EXPECT_NEAR(round.moment(0, weights).variance, round.moment(0).variance, 1e-12);
}

TEST(ClutterRound, AFootprintWeighsValuesByWhereTheyStand) {
  const ClutterRound round = filled(8, 11, true, [](double x, double, std::uint64_t) { return x; });
  // The left half of the pixel, whose centre is at (2.5, 3.5).
  const std::vector<double> weights = round.weigh(PixelFootprint::box(1.0), {2.0, 3.5});
  EXPECT_NEAR(round.moment(0, weights).mean, 0.25, 0.02);
  EXPECT_NEAR(round.moment(0).mean, 0.5, 0.02);
}

/// The rim of a footprint may hold none of a few values: those then count alike, and never as 0.
TEST(ClutterRound, AFootprintOverNoValueLeavesThePlainMean) {
  const ClutterRound round = filled(4, 11, true, [](double, double, std::uint64_t) { return 5.0; });
  const std::vector<double> weights = round.weigh(PixelFootprint::box(1.0), {20.0, 3.5});
  EXPECT_DOUBLE_EQ(round.moment(0, weights).mean, 5.0);
}

/// Of a grid for many footprints, as ClutterRound has it for one: a slope, a border and noise, under the middle and the rim of a
/// footprint. `shifted_px`: a planted fault.
double largest_difference_of_grids(double shifted_px) {
  double most = 0.0;
  for (const int side : {4, 6, 18}) {
    const ClutterRound round = filled(side, hash(13, side), true, [](double x, double y, std::uint64_t path) {
      return x + (0.9 * x + 0.4 * y > 0.6 ? 2.0 : 0.0) + 0.1 * unit_double(path);
    });
    std::vector<double> values;
    for (int k = 0; k < 144; ++k)
      values.push_back(std::exp(-0.05 * ((k % 12 - 5.5) * (k % 12 - 5.5) + (k / 12 - 5.5) * (k / 12 - 5.5))));
    const PixelFootprint footprint = PixelFootprint::tabulated(1.2, 12, values);
    const int column = 0;
    ClutterGrid grid(round, {&column, 1});
    for (const Point2 centre : {Point2{2.5, 3.5}, {1.6, 3.9}, {3.6, 4.4}}) {
      const ClutterRound::Moment one = round.moment(column, round.weigh(footprint, centre));
      if (!grid.weigh(footprint, {centre.x + shifted_px, centre.y})) return INFINITY;
      const ClutterRound::Moment found = grid.moment(0);
      most = std::max({most, std::abs(found.mean / one.mean - 1.0),
                       std::abs(found.variance / one.variance - 1.0),
                       std::abs(found.freedom / one.freedom - 1.0)});
    }
  }
  return most;
}

TEST(ClutterGrid, SaysWhatItsRoundSays) {
  EXPECT_LT(largest_difference_of_grids(0.0), 1e-11);
  EXPECT_GT(largest_difference_of_grids(0.01), 1e-4) << "a shift that is not applied is seen";
}

TEST(ClutterGrid, KnowsWhereNoValueLiesUnderTheFootprint) {
  const ClutterRound round = filled(4, 11, true, [](double, double, std::uint64_t) { return 5.0; });
  const int column = 0;
  EXPECT_FALSE(ClutterGrid(round, {&column, 1}).weigh(PixelFootprint::box(1.0), {20.0, 3.5}));
}

TEST(ClutterRound, CountsMaterials) {
  const ClutterRound round = filled(4, 3, false, [](double, double, std::uint64_t) { return 1.0; });
  ASSERT_EQ(round.materials().size(), 2u);
  EXPECT_EQ(round.materials()[0], (std::pair<std::uint32_t, std::uint32_t>{7, 12}));
  EXPECT_EQ(round.materials()[1], (std::pair<std::uint32_t, std::uint32_t>{8, 4}));
}

}  // namespace
}  // namespace ifov::sampling::test_clutter_round
