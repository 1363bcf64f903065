#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sampling/pixel_footprint.h"

namespace ifov::sampling::test_pixel_footprint {
namespace {

PixelFootprint gaussian(double sigma, double half_width, int cells) {
  std::vector<double> values;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const double x = half_width * (2.0 * (i + 0.5) / cells - 1.0),
                   y = half_width * (2.0 * (j + 0.5) / cells - 1.0);
      values.push_back(3.0 * std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)));
    }
  return PixelFootprint::tabulated(half_width, cells, values);
}

TEST(PixelFootprint, BoxIsExact) {
  const PixelFootprint box = PixelFootprint::box(0.8);
  EXPECT_DOUBLE_EQ(box.half_width_px(), 0.4);
  EXPECT_TRUE(box.uniform());
  EXPECT_DOUBLE_EQ(box.density(0.39, -0.39), 1.0 / 0.64);
  EXPECT_DOUBLE_EQ(box.density(0.41, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(box.integral(-1.0, -1.0, 1.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(box.integral(0.0, 0.0, 9.0, 9.0), 0.25);
  EXPECT_DOUBLE_EQ(box.integral(0.1, 0.0, 0.3, 0.2), 0.2 * 0.2 / 0.64);
  EXPECT_DOUBLE_EQ(box.integral(0.5, 0.5, 0.9, 0.9), 0.0);
}

TEST(PixelFootprint, TabulatedIsNormalisedAndAdditive) {
  const PixelFootprint g = gaussian(0.6, 2.0, 64);
  EXPECT_FALSE(g.uniform());
  EXPECT_NEAR(g.integral(-2, -2, 2, 2), 1.0, 1e-12);
  EXPECT_NEAR(g.integral(-2, -2, 0.137, 2) + g.integral(0.137, -2, 2, 2), 1.0, 1e-12);
  const double half =
      0.5 * (1.0 + std::erf(0.5 / 0.6 / std::sqrt(2.0))) / std::erf(2.0 / 0.6 / std::sqrt(2.0)) -
      0.5 * (1.0 / std::erf(2.0 / 0.6 / std::sqrt(2.0)) - 1.0);
  EXPECT_NEAR(g.integral(-2, -2, 0.5, 2), half, 1e-3);
  EXPECT_NEAR(g.density(0.0, 0.0) / g.density(0.6, 0.0), std::exp(0.5), 3e-3);
  EXPECT_EQ(g.density(2.01, 0.0), 0.0);
}

/// To the last bit, within the table, on its rim and beyond.
TEST(PixelFootprint, DensitiesAreThoseOfSinglePlaces) {
  std::vector<double> x, y;
  for (int k = 0; k < 40; ++k)
    for (int l = 0; l < 40; ++l) x.push_back(-2.6 + 0.13 * k), y.push_back(-2.6 + 0.13 * l);
  const Point2 centre{0.07, -0.31};
  for (const PixelFootprint& f :
       {gaussian(0.6, 2.0, 16), PixelFootprint::tabulated(0.7, 1, {5.0}), PixelFootprint::box(0.9),
        PixelFootprint::tabulated(1.0, 2, {1.0, 2.0, 3.0, 0.0}),
        PixelFootprint::striped(0.8, {{-0.5, 0.2, 1.0, 2.0}, {0.2, 0.9, 2.0, 0.0}})}) {
    std::vector<double> found(x.size());
    f.densities(x, y, centre, found);
    for (std::size_t k = 0; k < x.size(); ++k)
      EXPECT_EQ(found[k], f.density(x[k] - centre.x, y[k] - centre.y)) << x[k] << ' ' << y[k];
  }
}

TEST(PixelFootprint, DensityIntegratesToOne) {
  for (const PixelFootprint& f : {gaussian(0.6, 2.0, 16), PixelFootprint::tabulated(0.7, 1, {5.0}),
                                  PixelFootprint::tabulated(1.0, 2, {1.0, 2.0, 3.0, 0.0})}) {
    double sum = 0.0;
    const int n = 480;
    const double w = f.half_width_px();
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        sum += f.density(w * (2.0 * (i + 0.5) / n - 1.0), w * (2.0 * (j + 0.5) / n - 1.0)) * 4.0 * w * w /
               (n * n);
    EXPECT_NEAR(sum, 1.0, 1e-4);
  }
}

// Small things are weighed by density(), the cells about them by integral(): where the two differ, so do small bright
// things from what they are.
TEST(PixelFootprint, IntegralIsThatOfTheDensity) {
  std::vector<double> values;
  constexpr int kCells = 9;
  for (int k = 0; k < kCells * kCells; ++k) values.push_back(1.0 + std::sin(1.7 * k));
  const PixelFootprint footprint = PixelFootprint::tabulated(1.5, kCells, values);
  for (const auto& [x0, y0, x1, y1] : {std::array{-0.31, 0.12, -0.27, 0.15},
                                       {-1.5, -1.5, -1.4, 1.5},
                                       {1.31, 1.2, 1.5, 1.5},
                                       {-0.7, -0.9, 0.4, 1.3},
                                       {-1.5, -1.5, 1.5, 1.5}}) {
    constexpr int kSteps = 900;
    double sum = 0.0;
    for (int j = 0; j < kSteps; ++j)
      for (int i = 0; i < kSteps; ++i)
        sum += footprint.density(x0 + (i + 0.5) / kSteps * (x1 - x0), y0 + (j + 0.5) / kSteps * (y1 - y0));
    sum *= (x1 - x0) * (y1 - y0) / (kSteps * kSteps);
    EXPECT_NEAR(footprint.integral(x0, y0, x1, y1), sum, 1e-5 * sum);
  }
}

TEST(PixelFootprint, RowsRunDownwards) {
  const PixelFootprint f = PixelFootprint::tabulated(1.0, 2, {1.0, 0.0, 0.0, 0.0});
  // Between the centres the density falls evenly: an eighth lies beyond the middle on each side.
  EXPECT_DOUBLE_EQ(f.integral(-1, -1, 0, 0), 0.875 * 0.875);
  EXPECT_DOUBLE_EQ(f.integral(0, -1, 1, 0), 0.875 * 0.125);
  EXPECT_DOUBLE_EQ(f.integral(0, 0, 1, 1), 0.125 * 0.125);
}

TEST(PixelFootprint, RefusesNonsense) {
  EXPECT_THROW(PixelFootprint::box(0.0), std::invalid_argument);
  EXPECT_THROW(PixelFootprint::box(std::nan("")), std::invalid_argument);
  EXPECT_THROW(PixelFootprint::tabulated(1.0, 2, {1.0}), std::invalid_argument);
  EXPECT_THROW(PixelFootprint::tabulated(1.0, 1, {-1.0}), std::invalid_argument);
  EXPECT_THROW(PixelFootprint::tabulated(1.0, 1, {0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace ifov::sampling::test_pixel_footprint
