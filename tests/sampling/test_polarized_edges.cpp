// Borders between surfaces that send the same radiance, polarized one way and the other: only Q and U tell them apart.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "accuracy_scenes.h"

namespace ifov::test::test_polarized_edges {
namespace {

constexpr double kRadiance = 130.0, kQ = 20.0, kU = 35.0;
constexpr int kShifts = 60;

/// 3 % of I for each of I, Q and U, or for I alone.
class OfRadiance final : public sampling::Tolerance {
 public:
  explicit OfRadiance(bool all) : all_(all) {}
  void limits(std::span<const double> mean, std::span<double> limit) const override {
    std::fill(limit.begin(), limit.end(), all_ ? 0.03 * std::abs(mean[0]) : INFINITY);
    limit[0] = 0.03 * std::abs(mean[0]);
  }
  double confidence() const override { return 0.95; }

 private:
  bool all_;
};

struct Told {
  int held = 0, judged = 0, sure = 0;
  double bias = 0.0;  ///< of the mean over the shifts, standard errors
};

/// A slab's corner in the middle of three by three pixels; the truth has `lost` px2 less of it.
Told corners(const std::vector<int>& steering, double noise, double lost, bool all_judged = true) {
  Told told;
  std::vector<double> errors[2];
  for (int shift = 0; shift < kShifts; ++shift) {
    Draw draw(9000 + static_cast<std::uint64_t>(shift));
    const double x = 1.05 + 0.25 * draw(), y = 1.05 + 0.25 * draw(), turn = 0.3 * (draw() - 0.5);
    const double c = std::cos(turn), s = std::sin(turn);
    sampling::Polygon slab = turned_rectangle(x - 2.0 * (c - s), y - 2.0 * (s + c), 4.0, 4.0, turn);
    ShapeField field(
        [&](double px, double py) {
          return static_cast<sampling::Label>(slab.contains({px, py}));
        },
        [&](sampling::Label label, double px, double py, int column) {
          const double one = label != 0 ? -1.0 : 1.0;
          const double grain =
              noise * (sampling::unit_double(sampling::hash(static_cast<std::uint64_t>(1e9 * px),
                                                            static_cast<std::uint64_t>(1e9 * py))) -
                       0.5);
          return static_cast<float>((1.0 + grain) * (column == 0   ? kRadiance
                                                     : column == 1 ? one * kQ
                                                                   : one * kU));
        },
        3);
    const OfRadiance tolerance(all_judged);
    const sampling::PixelFootprint box = sampling::PixelFootprint::box(1.0);
    sampling::TileProblem problem;
    problem.tile = {0, 0, 3, 3};
    problem.image = {-4, -4, 7, 7};
    problem.seed = 77 + static_cast<std::uint64_t>(shift);
    problem.footprint = &box;
    problem.tolerance = &tolerance;
    problem.steering_channels = steering;
    sampling::TileResult result;
    sampling::AccuracySampler(sampling::AccuracyOptions()).sample(problem, field, result);
    const double share = polygon_in_rectangle(slab, 1, 1, 2, 2) - lost;
    told.sure += result.converged(4);
    for (int column : {1, 2}) {
      const double truth = (column == 1 ? kQ : kU) * (1.0 - 2.0 * share);
      const double error = static_cast<double>(result.mean[4 * 3 + column]) - truth;
      told.held += std::abs(error) <= static_cast<double>(result.half_width[4 * 3 + column]);
      ++told.judged;
      errors[column - 1].push_back(error);
    }
  }
  for (const std::vector<double>& of : errors) {
    double mean = 0.0, squares = 0.0;
    for (const double e : of) mean += e / kShifts;
    for (const double e : of) squares += (e - mean) * (e - mean);
    const double z = mean / std::sqrt(squares / (kShifts - 1.0) / kShifts);
    if (std::abs(z) > std::abs(told.bias)) told.bias = z;
  }
  return told;
}

// Between bends and corners the few rays that this contrast is worth have to tell.
TEST(PolarizedEdges, CornersAreWithinTheIntervals) {
  for (const double noise : {0.0, 0.02}) {
    const Told told = corners({0, 1, 2}, noise, 0.0);
    EXPECT_GE(told.held, 0.93 * told.judged) << noise;
    EXPECT_LE(std::abs(told.bias), 4.0) << noise;
    EXPECT_GE(told.sure, 0.9 * kShifts) << noise;
  }
  // Planted fault: a corner cut off, as by an arc in its place.
  const Told blunt = corners({0, 1, 2}, 0.0, 0.015);
  EXPECT_LT(blunt.held, 0.5 * blunt.judged);
  EXPECT_GT(std::abs(blunt.bias), 4.0);
}

// A sensor of many channels is steered by some of them: a border that only others see is traced for those.
TEST(PolarizedEdges, ColumnsThatAloneSeeABorderSteer) {
  for (const double noise : {0.0, 0.02}) {
    const Told told = corners({0}, noise, 0.0);
    EXPECT_GE(told.held, 0.93 * told.judged) << noise;
    EXPECT_LE(std::abs(told.bias), 4.0) << noise;
    EXPECT_GE(told.sure, 0.9 * kShifts) << noise;
  }
  // Planted fault: they do not, as if nobody asked for their errors.
  const Told blind = corners({0}, 0.02, 0.0, false);
  EXPECT_LT(blind.held, 0.93 * blind.judged);
  EXPECT_GT(std::abs(blind.bias), 4.0);
}

}  // namespace
}  // namespace ifov::test::test_polarized_edges
