// Cubic interpolation of the sky's table, against functions that are known everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "transport/sky/sky_refinement.h"

namespace ifov::transport::test_sky_refinement {
namespace {

using Sky = std::function<double(double zenith, double azimuth)>;

SkyGrid grid_of_tens() {
  SkyGrid grid;
  for (int k = 0; k < 9; ++k) grid.zenith_rad.push_back(k * std::numbers::pi / 18.0);
  for (int k = 0; k <= 18; ++k) grid.azimuth_rad.push_back(k * std::numbers::pi / 18.0);
  return grid;
}

radiometry::SpectrumBlock table(const SkyGrid& grid, const Sky& sky) {
  radiometry::SpectrumBlock block(grid.zenith_rad.size() * grid.azimuth_rad.size(), 1);
  std::size_t row = 0;
  for (const double zenith : grid.zenith_rad)
    for (const double azimuth : grid.azimuth_rad)
      block.row(row++)[0] = static_cast<float>(sky(zenith, azimuth));
  return block;
}

double worst(const Sky& sky, float sign) {
  const SkyGrid grid = grid_of_tens(), finer = refined(grid);
  const radiometry::SpectrumBlock found = refined(grid, table(grid, sky), sign);
  double off = 0.0;
  std::size_t row = 0;
  for (const double zenith : finer.zenith_rad)
    for (const double azimuth : finer.azimuth_rad)
      off = std::max(off, std::abs(static_cast<double>(found.row(row++)[0]) - sky(zenith, azimuth)));
  return off;
}

TEST(SkyRefinement, SmoothSkiesAreFoundBetweenDirections) {
  const Sky even = [](double zenith, double azimuth) {
    return 1.0 + 0.5 * std::sin(zenith) * std::cos(azimuth) + 0.2 * std::cos(2.0 * azimuth);
  };
  const Sky odd = [](double zenith, double azimuth) { return std::cos(zenith) * std::sin(2.0 * azimuth); };
  EXPECT_LT(worst(even, 1.0f), 2e-4);
  EXPECT_LT(worst(odd, -1.0f), 5e-4);
  // Planted fault: U that does not change its sign across the Sun's plane. Linear interpolation misses 4e-3 and 0.015.
  EXPECT_GT(worst(odd, 1.0f), 1e-2);
}

TEST(SkyRefinement, NodesStayAndPeaksDoNotRing) {
  const SkyGrid grid = grid_of_tens(), finer = refined(grid);
  const Sky peak = [](double zenith, double azimuth) {
    return zenith > 0.68 && zenith < 0.71 && azimuth < 0.01 ? 100.0 : 1.0;
  };
  const radiometry::SpectrumBlock before = table(grid, peak), found = refined(grid, before, 1.0f);
  float least = 1e9f, most = 0.0f;
  for (std::size_t z = 0; z < finer.zenith_rad.size(); ++z)
    for (std::size_t a = 0; a < finer.azimuth_rad.size(); ++a) {
      const float value = found.row(z * finer.azimuth_rad.size() + a)[0];
      least = std::min(least, value), most = std::max(most, value);
      if (z % kSkyRefinement == 0 && a % kSkyRefinement == 0) {
        EXPECT_FLOAT_EQ(value,
                        before.row(z / kSkyRefinement * grid.azimuth_rad.size() + a / kSkyRefinement)[0]);
      }
    }
  EXPECT_GE(least, 0.99f);  // an unlimited cubic has -11
  EXPECT_LE(most, 100.1f);
}

}  // namespace
}  // namespace ifov::transport::test_sky_refinement
