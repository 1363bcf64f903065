#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/run_control.h"
#include "sampling/adaptive_sampler.h"
#include "sampling/grid_sampler.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tolerance.h"
#include "shape_field.h"

namespace ifov::sampling::test_samplers {
namespace {

const PixelFootprint kWholePixel = PixelFootprint::box(1.0);

TileProblem problem_of(PixelRect tile, PixelRect image, const PixelFootprint& footprint = kWholePixel) {
  TileProblem problem;
  problem.tile = tile;
  problem.image = image;
  problem.seed = 5;
  problem.footprint = &footprint;
  return problem;
}

TileResult render(const PixelSampler& sampler, Field& field, const TileProblem& problem) {
  TileResult result;
  sampler.sample(problem, field, result);
  return result;
}

std::uint64_t total_samples(const TileResult& r) {
  std::uint64_t n = r.halo_samples;
  for (auto s : r.samples) n += s;
  return n;
}

/// The paper's study 2: a disc of half a pixel's area in the middle of 3 x 3 pixels.
test::ShapeField half_disc() { return test::disc_field(1.5, 1.5, std::sqrt(0.5 / std::numbers::pi)); }
const PixelRect kNine{0, 0, 3, 3};

class FixedTolerance final : public Tolerance {
 public:
  explicit FixedTolerance(double limit) : limit_(limit) {}
  void limits(std::span<const double>, std::span<double> limit) const override {
    for (double& l : limit) l = limit_;
  }
  double confidence() const override { return 0.95; }

 private:
  double limit_;
};

// ---- single

TEST(SingleSampler, LooksThroughTheCentreWhateverTheFootprint) {
  for (const PixelFootprint& footprint : {kWholePixel, PixelFootprint::box(0.3), PixelFootprint::box(4.0)}) {
    auto field = half_disc();
    const TileResult r = render(SingleSampler(), field, problem_of({1, 0, 3, 2}, kNine, footprint));
    ASSERT_EQ(field.seen.size(), 4u);
    EXPECT_EQ(field.seen[2].point.x_px, 1.5);
    EXPECT_EQ(field.seen[2].point.y_px, 1.5);
    EXPECT_EQ(r.mean, (std::vector<float>{0, 0, 1, 0}));
    EXPECT_EQ(r.samples, (std::vector<std::uint32_t>{1, 1, 1, 1}));
    EXPECT_EQ(r.rays.primary, 4u);
    EXPECT_EQ(r.halo_samples, 0u);
  }
}

TEST(SingleSampler, ClaimsNothingAboutItsError) {
  auto field = half_disc();
  TileProblem problem = problem_of(kNine, kNine);
  const FixedTolerance loose(1e9);
  problem.tolerance = &loose;
  const TileResult r = render(SingleSampler(), field, problem);
  EXPECT_FALSE(r.has_errors());
  EXPECT_EQ(r.reasons[4], bit(Reason::unjudged));
  EXPECT_TRUE(std::isinf(r.worst_ratio[4]));
  EXPECT_NEAR(r.missable_fraction[4], 0.95, 1e-6);
  ASSERT_EQ(r.abundances.size(), 9u);
  EXPECT_EQ(r.abundances[4].material, 1u);
  EXPECT_EQ(r.abundances[4].fraction, 1.0f);
  EXPECT_TRUE(std::isnan(r.abundances[4].half_width));
}

// ---- grid

/// Errors of the paper's grid in degrees by its linear conversion, 19.8726 degrees a unit of area.
double grid_error_c(int n) {
  auto field = half_disc();
  const TileResult r = render(GridSampler(n, n), field, problem_of(kNine, kNine));
  EXPECT_EQ(total_samples(r), static_cast<std::uint64_t>(9 * n * n));
  return std::abs(static_cast<double>(r.mean[4]) - 0.5) * 19.8726;
}

TEST(GridSampler, ReproducesTheGridOfStudyTwo) {
  EXPECT_NEAR(grid_error_c(2), 9.94, 0.005);
  EXPECT_NEAR(grid_error_c(6), 1.10, 0.005);
  EXPECT_NEAR(grid_error_c(8), 0.0, 1e-5);
  EXPECT_NEAR(grid_error_c(10), 0.40, 0.005);
  EXPECT_NEAR(grid_error_c(40), 0.149, 0.0005);
  EXPECT_NEAR(grid_error_c(42), 0.022, 0.001);
}

TEST(GridSampler, CountsAgainstADirectLoop) {
  const int n = 7, m = 4;
  auto field = test::disc_field(1.3, 0.8, 0.9);
  const TileResult r = render(GridSampler(n, m), field, problem_of({0, 0, 3, 2}, {0, 0, 3, 2}));
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) {
      int inside = 0;
      for (int b = 0; b < m; ++b)
        for (int a = 0; a < n; ++a)
          inside += std::hypot(i + (a + 0.5) / n - 1.3, j + (b + 0.5) / m - 0.8) < 0.9;
      EXPECT_NEAR(r.mean[static_cast<std::size_t>(j * 3 + i)], inside / double(n * m), 1e-6);
    }
}

TEST(GridSampler, FillFactorShrinksTheSensitiveSquare) {
  const PixelFootprint half = PixelFootprint::box(0.5);
  auto field = half_disc();
  const TileResult r = render(GridSampler(8, 8), field, problem_of({1, 1, 2, 2}, kNine, half));
  EXPECT_EQ(r.mean[0], 1.0f);  // the disc's radius of 0.399 holds the square's corners at 0.354
  for (const auto& q : field.seen) {
    EXPECT_GT(q.point.x_px, 1.25);
    EXPECT_LT(q.point.x_px, 1.75);
  }
}

PixelFootprint gaussian(double sigma) {
  std::vector<double> values;
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 80; ++i) {
      const double x = (i + 0.5) / 20.0 - 2.0, y = (j + 0.5) / 20.0 - 2.0;
      values.push_back(std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)));
    }
  return PixelFootprint::tabulated(2.0, 80, values);
}

TEST(WideFootprint, EdgeSpreadFollowsThePsf) {
  const PixelFootprint psf = gaussian(0.6);
  // An edge 0.27 px right of the centre of pixel 4.
  const auto edge = [] {
    return test::ShapeField([](double x, double) { return static_cast<Label>(x > 4.77); },
                            [](Label label, double, double, int) { return static_cast<float>(label); });
  };
  const double cut = std::erf(2.0 / 0.6 / std::numbers::sqrt2);
  const double truth = 0.5 - 0.5 * std::erf(0.27 / 0.6 / std::numbers::sqrt2) / cut;
  auto grid_sees = edge();
  const TileResult grid = render(GridSampler(10, 10), grid_sees, problem_of({4, 4, 5, 5}, {0, 0, 9, 9}, psf));
  EXPECT_NEAR(grid.mean[0], truth, 0.02);
  EXPECT_EQ(grid.samples[0], 100u);
  EXPECT_EQ(grid.halo_samples, 1500u);
  auto adaptive_sees = edge();
  const TileResult adaptive =
      render(AdaptiveSampler({.sub_elements_x = 5, .sub_elements_y = 5, .rotate_points = true}),
             adaptive_sees, problem_of({4, 4, 5, 5}, {0, 0, 9, 9}, psf));
  EXPECT_NEAR(adaptive.mean[0], truth, 0.02);
  EXPECT_LE(std::abs(adaptive.mean[0] - truth), adaptive.half_width[0]);
}

TEST(GridSampler, VarianceIsThatOfIndependentPoints) {
  auto field = half_disc();
  const TileResult r = render(GridSampler(8, 8), field, problem_of(kNine, kNine));
  EXPECT_NEAR(r.variance_geometry[4], 0.25 / 63.0, 1e-6);
  EXPECT_EQ(r.variance_path[4], 0.0f);
  EXPECT_NEAR(r.half_width[4], 1.99834 * std::sqrt(0.25 / 63.0), 1e-5);
  EXPECT_NEAR(r.abundances[4].fraction + r.abundances[5].fraction, 1.0, 1e-6);
}

TEST(GridSampler, TextureUnderOneLabelIsPathVariance) {
  test::ShapeField field([](double, double) { return Label{3}; },
                         [](Label, double x, double, int c) { return static_cast<float>(c + x); }, 2);
  const TileResult r = render(GridSampler(4, 1), field, problem_of({0, 0, 1, 1}, {0, 0, 1, 1}));
  EXPECT_NEAR(r.mean[1], 1.5, 1e-6);
  EXPECT_EQ(r.variance_geometry[0], 0.0f);
  EXPECT_NEAR(r.variance_path[0], (0.375 * 0.375 + 0.125 * 0.125) * 2 / 3 / 4, 1e-6);
}

TEST(ClassicalSamplers, UniformSceneIsExactWithoutVariance) {
  const PixelFootprint psf = gaussian(0.6);
  for (const PixelFootprint* footprint : {&kWholePixel, &psf}) {
    auto field = test::uniform_field(0.1f);
    const TileProblem problem = problem_of({2, 2, 5, 4}, {0, 0, 8, 8}, *footprint);
    const TileResult grid = render(GridSampler(3, 3), field, problem);
    const TileResult adaptive = render(AdaptiveSampler({}), field, problem);
    for (const TileResult* r : {&grid, &adaptive})
      for (std::size_t p = 0; p < 6; ++p) {
        EXPECT_FLOAT_EQ(r->mean[p], 0.1f);
        EXPECT_LT(r->half_width[p], 1e-8f);
        EXPECT_EQ(r->samples[p], 9u);
      }
  }
}

// ---- adaptive

TileResult adaptive_study(int n, bool rotate, std::uint64_t seed = 5) {
  auto field = half_disc();
  TileProblem problem = problem_of(kNine, kNine);
  problem.seed = seed;
  AdaptiveOptions options;
  options.sub_elements_x = options.sub_elements_y = n / 2;
  options.max_samples = n * n;
  options.allowed_difference = 1e-3;
  options.relative = false;
  options.rotate_points = rotate;
  return render(AdaptiveSampler(options), field, problem);
}

TEST(AdaptiveSampler, ReproducesTheCountOfStudyTwo) {
  EXPECT_EQ(total_samples(adaptive_study(20, false)), 1119u);
  EXPECT_EQ(total_samples(adaptive_study(2, false)),
            36u);  // the disc's pixel and its eight neighbours differ
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    mean += static_cast<double>(total_samples(adaptive_study(20, true, seed))) / 40.0;
  EXPECT_NEAR(mean, 1130.0, 4.0);
}

TEST(AdaptiveSampler, RefinesOnlyAroundTheEdge) {
  const TileResult r = adaptive_study(20, false);
  for (std::size_t p = 0; p < 9; ++p)
    if (p != 4) {
      EXPECT_EQ(r.samples[p], 100u);
    }
  EXPECT_EQ(r.samples[4], 319u);
}

// Labels come with values: every ray of a pixel is both, and the counts say so.
TEST(AdaptiveSampler, EverySampleIsARadianceEvaluation) {
  const TileResult r = adaptive_study(20, true);
  EXPECT_EQ(r.radiance_evaluations, r.samples);
}

TEST(AdaptiveSampler, ErrorsLieWithinTheIntervals) {
  int inside = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const TileResult r = adaptive_study(20, true, seed);
    inside += std::abs(r.mean[4] - 0.5f) <= r.half_width[4];
    EXPECT_GT(r.variance_geometry[4], 0.0f);
  }
  EXPECT_GE(inside, 93);
}

TEST(AdaptiveSampler, ThresholdDecidesWhether) {
  test::ShapeField field([](double x, double) { return static_cast<Label>(x > 1.0); },
                         [](Label label, double, double, int) { return 10.0f + static_cast<float>(label); });
  AdaptiveOptions options{.sub_elements_x = 2, .sub_elements_y = 2, .max_samples = 16};
  options.allowed_difference = 0.11;
  EXPECT_EQ(total_samples(render(AdaptiveSampler(options), field, problem_of({0, 0, 2, 1}, {0, 0, 2, 1}))),
            8u);
  options.allowed_difference = 0.09;
  EXPECT_EQ(total_samples(render(AdaptiveSampler(options), field, problem_of({0, 0, 2, 1}, {0, 0, 2, 1}))),
            20u);
}

TEST(AdaptiveSampler, OnlyDriversAreJudged) {
  test::ShapeField field(
      [](double x, double) { return static_cast<Label>(x > 0.5); },
      [](Label label, double, double, int c) { return c == 1 ? static_cast<float>(label) : 1.0f; }, 2);
  const int quiet[] = {0};
  TileProblem problem = problem_of({0, 0, 1, 1}, {0, 0, 1, 1});
  problem.steering_channels = quiet;
  EXPECT_EQ(total_samples(render(AdaptiveSampler({}), field, problem)), 9u);
  problem.steering_channels = {};
  EXPECT_GT(total_samples(render(AdaptiveSampler({}), field, problem)), 9u);
}

TEST(AdaptiveSampler, TheHaloHoldsTwoSubElementsAlongBothSides) {
  for (const auto& [x, y] : {std::pair{1, 4}, {4, 1}, {2, 5}, {3, 3}}) {
    const int halo = AdaptiveSampler({.sub_elements_x = x, .sub_elements_y = y, .max_samples = 64}).halo_px();
    EXPECT_GE(halo * std::min(x, y), 2) << x << " x " << y;
    EXPECT_LT((halo - 1) * std::min(x, y), 2) << x << " x " << y;  // and no pixel more
  }
}

TEST(AdaptiveSampler, RefusesNonsense) {
  EXPECT_THROW(AdaptiveSampler({.sub_elements_x = 0}), std::invalid_argument);
  EXPECT_THROW(AdaptiveSampler({.max_samples = 8}), std::invalid_argument);
  EXPECT_THROW(AdaptiveSampler({.allowed_difference = -1.0}), std::invalid_argument);
  EXPECT_THROW(GridSampler(0, 1), std::invalid_argument);
}

// ---- all

TEST(ClassicalSamplers, TilesGiveTheSameBytesAsTheWhole) {
  const PixelFootprint psf = gaussian(0.6);
  const PixelRect image{0, 0, 6, 5};
  const GridSampler grid(4, 3);
  const AdaptiveSampler adaptive(
      {.sub_elements_x = 4, .sub_elements_y = 4, .max_samples = 64, .rotate_points = true});
  for (const PixelSampler* sampler :
       {static_cast<const PixelSampler*>(&grid), static_cast<const PixelSampler*>(&adaptive)})
    for (const PixelFootprint* footprint : {&kWholePixel, &psf}) {
      auto field = test::disc_field(2.7, 2.2, 1.4);
      const TileResult whole = render(*sampler, field, problem_of(image, image, *footprint));
      for (int y0 : {0, 2})
        for (int x0 : {0, 3}) {
          const PixelRect tile{x0, y0, x0 + 3, y0 == 0 ? 2 : 5};
          const TileResult part = render(*sampler, field, problem_of(tile, image, *footprint));
          for (int j = tile.y0; j < tile.y1; ++j)
            for (int i = tile.x0; i < tile.x1; ++i) {
              const auto p = static_cast<std::size_t>((j - tile.y0) * 3 + i - x0);
              const auto w = static_cast<std::size_t>(j * 6 + i);
              EXPECT_EQ(part.mean[p], whole.mean[w]);
              EXPECT_EQ(part.half_width[p], whole.half_width[w]);
              EXPECT_EQ(part.samples[p], whole.samples[w]);
            }
        }
    }
}

TEST(ClassicalSamplers, PathsOfAPixelAreNumberedWithoutRepeats) {
  auto field = half_disc();
  render(AdaptiveSampler({}), field, problem_of(kNine, kNine));
  std::map<std::pair<std::uint64_t, std::uint32_t>, int> uses;
  for (const auto& q : field.seen) EXPECT_EQ(uses[std::pair(q.sequence, q.index)]++, 0);
}

TEST(ClassicalSamplers, StopOnRequest) {
  CancelToken cancel;
  cancel.cancel();
  TileProblem problem = problem_of(kNine, kNine);
  problem.cancel = &cancel;
  auto field = half_disc();
  EXPECT_THROW(render(SingleSampler(), field, problem), Cancelled);
  EXPECT_THROW(render(GridSampler(2, 2), field, problem), Cancelled);
  EXPECT_THROW(render(AdaptiveSampler({}), field, problem), Cancelled);
}

TEST(ClassicalSamplers, ToleranceOnlyJudges) {
  const FixedTolerance strict(1e-3), loose(0.5);
  for (const Tolerance* tolerance :
       {static_cast<const Tolerance*>(&strict), static_cast<const Tolerance*>(&loose)}) {
    TileProblem problem = problem_of(kNine, kNine);
    problem.tolerance = tolerance;
    auto field = half_disc();
    const TileResult r = render(GridSampler(10, 10), field, problem);
    EXPECT_EQ(r.samples[4], 100u);
    EXPECT_EQ(r.reasons[4], tolerance == &loose ? 0 : bit(Reason::samples));
    EXPECT_TRUE(r.converged(0));
    EXPECT_NEAR(r.worst_ratio[4], r.half_width[4] / (tolerance == &loose ? 0.5f : 1e-3f),
                1e-4 * r.worst_ratio[4]);
  }
}

}  // namespace
}  // namespace ifov::sampling::test_samplers
