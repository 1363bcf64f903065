// Where maps are lowest and highest, against a look at every cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "materials/draped_map.h"

namespace ifov::materials::test_numbered_map {
namespace {

/// Turned windows of all sizes over a map of 45 x 37 cells, most of them beyond its edges.
void expect_as_cell_by_cell(Tiling across, Tiling down) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  MapGrid grid{0.0, 37.0, 1.0, 1.0, 45, 37, across, MapBy::position, down};
  std::vector<float> kelvins(45 * 37);
  for (float& t : kelvins) t = static_cast<float>(250.0 + 60.0 * unit(random));
  const TemperatureMap map(grid, kelvins);
  int found_any = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double a = -60.0 + 160.0 * unit(random), b = -50.0 + 130.0 * unit(random),
                 size = 1.0 + 40.0 * unit(random) * unit(random), angle = 7.0 * unit(random);
    const auto inside = [&](double column, double row) {
      const double x = std::cos(angle) * (column - a) + std::sin(angle) * (row - b),
                   y = std::cos(angle) * (row - b) - std::sin(angle) * (column - a);
      return std::abs(x) < 0.5 * size && std::abs(y) < 0.25 * size;
    };
    double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
    for (double row = std::floor(b - size); row < b + size; row += 1.0)
      for (double column = std::floor(a - size); column < a + size; column += 1.0) {
        if (!inside(column + 0.5, row + 0.5)) continue;
        if (across == Tiling::edge && (column < 0.0 || column >= 45.0)) continue;
        if (down == Tiling::edge && (row < 0.0 || row >= 37.0)) continue;
        const double t = static_cast<double>(
            map.number(grid.cell_at(MapPosition{column + 0.5, 37.0 - row - 0.5, 0.0, 0.0})));
        lowest = std::min(lowest, t);
        highest = std::max(highest, t);
      }
    const NumberedMap::Extremes found = map.extremes(a - size, b - size, a + size, b + size, inside);
    ASSERT_EQ(found.any, highest > 0.0);
    if (!found.any) continue;
    ++found_any;
    EXPECT_EQ(static_cast<double>(found.lowest.number), lowest);
    EXPECT_EQ(static_cast<double>(found.highest.number), highest);
    EXPECT_TRUE(inside(found.highest.column, found.highest.row));
    EXPECT_EQ(map.number(grid.cell_at(MapPosition{found.highest.column, 37.0 - found.highest.row, 0.0, 0.0})),
              found.highest.number);
  }
  EXPECT_GT(found_any, 40);
}

TEST(NumberedMap, ExtremesAreThoseOfAllCellsInside) {
  for (const Tiling across : {Tiling::edge, Tiling::repeat, Tiling::mirror})
    for (const Tiling down : {Tiling::edge, Tiling::repeat, Tiling::mirror})
      expect_as_cell_by_cell(across, down);
}

// More copies than are looked through: each of those in the middle of a turned window holds all there is.
TEST(NumberedMap, ManyCopiesAreAsOne) {
  for (const Tiling tiling : {Tiling::repeat, Tiling::mirror}) {
    const TemperatureMap map({0.0, 2.0, 1.0, 1.0, 3, 2, tiling},
                             {300.0f, 301.0f, 290.0f, 302.0f, 900.0f, 299.0f});
    const auto inside = [](double column, double row) {
      return std::abs(column - 40.0) + std::abs(row + 7.0) < 60.0;
    };
    const NumberedMap::Extremes found = map.extremes(-20.0, -67.0, 100.0, 53.0, inside);
    ASSERT_TRUE(found.any);
    EXPECT_EQ(found.lowest.number, 290.0f);
    EXPECT_EQ(found.highest.number, 900.0f);
    EXPECT_TRUE(inside(found.highest.column, found.highest.row));
  }
}

}  // namespace
}  // namespace ifov::materials::test_numbered_map
