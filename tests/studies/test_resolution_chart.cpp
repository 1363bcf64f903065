#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>

#include "studies/resolution_chart.h"
#include "support/truth_data.h"

namespace ifov::studies::test_resolution_chart {
namespace {

TEST(ResolutionChart, LinePairsOfTheStandard) {
  const char* name = "mtf/usaf1951.csv";
  const auto path = test::truth_file(name);
  if (!path) GTEST_SKIP() << "reference data not found: " << name;
  std::ifstream file(*path);
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream in(line);
    int group = 0, element = 0;
    double lp_per_mm = 0.0, bar_width_mm = 0.0;
    in >> group >> element >> lp_per_mm >> bar_width_mm;
    EXPECT_NEAR(line_pairs_per_mm(group, element), lp_per_mm, 1e-6) << line;
    EXPECT_NEAR(0.5 / line_pairs_per_mm(group, element), bar_width_mm, 1e-8) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 72);
}

TEST(ResolutionChart, BarsHaveTheRatiosOfTheStandard) {
  ChartPlacement placement;
  placement.px_per_mm = 2.0;
  placement.angle_rad = 0.4;
  const std::vector<Outline> bars = chart_bars(0, 1, placement);
  ASSERT_EQ(bars.size(), 72u);
  const auto side = [](const Outline& o, std::size_t k) {
    return std::hypot(o[k + 1].x_px - o[k].x_px, o[k + 1].y_px - o[k].y_px);
  };
  EXPECT_NEAR(side(bars[0], 0), 0.5 * 2.0, 1e-12);  // upright: width, then length
  EXPECT_NEAR(side(bars[0], 1), 2.5 * 2.0, 1e-12);
  EXPECT_NEAR(side(bars[1], 0), 2.5 * 2.0, 1e-12);  // lying
  EXPECT_NEAR(side(bars[36], 0), 0.25 * 2.0, 1e-12);
  EXPECT_NEAR(side(bars[6], 0) / side(bars[0], 0), std::pow(2.0, -1.0 / 6.0), 1e-12);
}

TEST(ResolutionChart, BarsDoNotOverlap) {
  const std::vector<Outline> bars = chart_bars(-1, 1, {20, 20, 4.0, 0.0});
  const auto bounds = [](const Outline& o) { return std::array{o[0].x_px, o[0].y_px, o[2].x_px, o[2].y_px}; };
  for (std::size_t a = 0; a < bars.size(); ++a)
    for (std::size_t b = a + 1; b < bars.size(); ++b) {
      const auto p = bounds(bars[a]);
      EXPECT_NEAR(area_in_rectangle(bars[b], p[0], p[1], p[2], p[3]), 0.0, 1e-12) << a << " " << b;
    }
}

TEST(ResolutionChart, CoverageAddsUpToTheBars) {
  const std::vector<Outline> bars = chart_bars(-2, 0, {32, 32, 0.6, 0.7});
  const std::vector<double> covered = covered_fraction(bars, 64, 64);
  double bar_area = 0.0;
  for (const Outline& bar : bars) bar_area += area(bar);
  EXPECT_NEAR(std::accumulate(covered.begin(), covered.end(), 0.0), bar_area, 1e-9);
  for (double c : covered) EXPECT_LE(c, 1.0 + 1e-12);
}

}  // namespace
}  // namespace ifov::studies::test_resolution_chart
