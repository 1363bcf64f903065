#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sampling/accuracy/borders/polygon.h"
#include "sampling/accuracy/weights/cell_weights.h"
#include "sampling/accuracy/weights/polygon_fan.h"
#include "sampling/accuracy/weights/polygon_nodes.h"
#include "sampling/footprint_groups.h"

namespace ifov::sampling::test_group_weights {
namespace {

PixelFootprint gaussian(double sigma, double half_width, int cells) {
  std::vector<double> values;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const double x = half_width * (2.0 * (i + 0.5) / cells - 1.0),
                   y = half_width * (2.0 * (j + 0.5) / cells - 1.0);
      values.push_back(std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)));
    }
  return PixelFootprint::tabulated(half_width, cells, values);
}

Polygon pentagon() {
  Polygon polygon;
  for (const Point2 p : {Point2{0.1, 0.2}, {0.8, 0.15}, {1.0, 0.6}, {0.6, 0.95}, {0.15, 0.8}}) polygon.add(p);
  return polygon;
}

/// Places that triangles share count for both.
TEST(PolygonNodes, IntegrateAsTheFanDoes) {
  const PixelFootprint footprint = gaussian(0.5, 2.0, 64);
  const Point2 centre{0.4, 0.7};
  for (const double longest : {9.0, 0.5, 0.21, 0.05}) {
    PolygonNodes nodes;
    nodes.place(pentagon(), longest);
    const double fan = over_fan(
        pentagon(), [&](Point2 m) { return footprint.density(m.x - centre.x, m.y - centre.y); }, longest);
    EXPECT_NEAR(nodes.over(footprint, centre) / fan, 1.0, 1e-12) << longest;
  }
}

TEST(PolygonNodes, AreExactForAnEvenDensity) {
  PolygonNodes nodes;
  nodes.place(pentagon(), 0.2);
  EXPECT_NEAR(nodes.over(PixelFootprint::box(8.0), {0.0, 0.0}), pentagon().signed_area() / 64.0, 1e-15);
}

/// Of a Gaussian over the half plane x < 0.3 within a cell: error functions.
TEST(PolygonNodes, IntegrateAGaussianOverARectangle) {
  const double sigma = 0.4, scale = sigma * std::sqrt(2.0);
  Polygon part;
  for (const Point2 p : {Point2{0.0, 0.0}, {0.3, 0.0}, {0.3, 1.0 / 3.0}, {0.0, 1.0 / 3.0}}) part.add(p);
  PolygonNodes nodes;
  nodes.place(part, 0.1);
  const auto along = [&](double from, double to) {
    return 0.5 * (std::erf(to / scale) - std::erf(from / scale)) / std::erf(2.0 / scale);
  };
  EXPECT_NEAR(nodes.over(gaussian(sigma, 2.0, 256), {-0.2, 0.1}),
              along(0.2, 0.5) * along(-0.1, 1.0 / 3.0 - 0.1), 4e-5);
}

TEST(CellWeights, AreTheIntegralsOfEachGroup) {
  const FootprintGroups groups({{gaussian(0.3, 1.3, 42), {0.0, 0.0}}, {gaussian(0.6, 2.4, 77), {0.4, -0.7}}},
                               {0, 1});
  const PixelFootprint none = PixelFootprint::box(1.0);
  const std::vector<int> channels{0, 1};
  const ColumnFootprints footprints(none, &groups, channels);
  const CellWeights weights(footprints, 3);
  for (std::size_t g = 0; g < 2; ++g) {
    double all = 0.0;
    for (int dy = -footprints.reach(); dy <= footprints.reach(); ++dy)
      for (int dx = -footprints.reach(); dx <= footprints.reach(); ++dx) {
        EXPECT_NEAR(weights.of_pixel(g, dx, dy),
                    footprints.integral(g, 0, dx - 0.5, dy - 0.5, dx + 0.5, dy + 0.5), 1e-14);
        double cells = 0.0;
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) cells += weights.of_cell(g, 3 * dx + i, 3 * dy + j);
        EXPECT_NEAR(cells, weights.of_pixel(g, dx, dy), 1e-14);
        all += cells;
      }
    EXPECT_NEAR(all, 1.0, 1e-12);
  }
  EXPECT_NE(weights.of_pixel(0, 1, -1), weights.of_pixel(1, 1, -1)) << "each has its own";
  EXPECT_GT(weights.of_pixel(1, 1, -1), weights.of_pixel(1, -1, 1)) << "it is shifted right and up";
}

}  // namespace
}  // namespace ifov::sampling::test_group_weights
