#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/spherical_reference.h"
#include "support/spherical_monte_carlo.h"

using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;
using ifov::test::SphericalMonteCarlo;
namespace test_spherical_monte_carlo {

namespace {

SphericalMonteCarlo shells(double depth, double sun_deg, double radius_km = 6371.0, double denser = 1.0) {
  Column column = molecules(depth * denser);
  return SphericalMonteCarlo(column.levels.altitude_km, column.optics.rayleigh_scattering, sun_deg * kDegree,
                             radius_km);
}

}  // namespace

TEST(SphericalMonteCarlo, IsTheFlatSolutionWhereTheEarthIsHuge) {
  constexpr double kHuge_km = 6.371e6;
  const ColumnSolution flat = solve_molecules(0.35, 60.0, false);
  const auto off = [&](double denser) {
    const SphericalMonteCarlo::Light sky =
        shells(0.35, 60.0, kHuge_km, denser).sky(60.0 * kDegree, 1.5, 60000, 3);
    const double given = flat.sunlit().path({-0.5, 1.5}, 0.0).radiance().i;
    return std::abs(given / sky.all - 1.0) - 3.0 * sky.error / sky.all;
  };
  EXPECT_LT(off(1.0), 2e-3);
  EXPECT_GT(off(1.02), 2e-3) << "air that is 2 % denser passes";
}

TEST(SphericalMonteCarlo, HasHazeAsTheFlatSolutionHas) {
  constexpr double kHuge_km = 6.371e6;
  Row row;
  row.haze = true;
  row.depth = 0.1;
  const Column column = column_of(row);
  const ColumnSolution flat = solved(column, 60.0, false);
  const auto off = [&](double asymmetry) {
    SphericalMonteCarlo air(column.levels.altitude_km, column.optics.rayleigh_scattering, 60.0 * kDegree,
                            kHuge_km);
    air.add_haze(column.optics.aerosol_scattering, asymmetry);
    const SphericalMonteCarlo::Light sky = air.sky(60.0 * kDegree, 1.5, 100000, 3);
    const double given = flat.sunlit().path({-0.5, 1.5}, 0.0).radiance().i;
    return std::abs(given / sky.all - 1.0) - 3.0 * sky.error / sky.all;
  };
  EXPECT_LT(off(0.65), 3e-3);
  EXPECT_GT(off(0.62), 3e-3) << "haze that scatters less forward passes";
}

TEST(SphericalMonteCarlo, MakesItsTableAnew) {
  const auto off = [](double turned_deg) {
    double worst = 0.0;
    for (const Row& row : reference()) {
      if (row.haze || row.depth != 0.35 || row.zenith != 75.0 || row.sun != 89.0) continue;
      const SphericalMonteCarlo air = shells(row.depth, row.sun + turned_deg);
      const double zenith = row.zenith * kDegree, azimuth = row.azimuth * kDegree;
      const SphericalMonteCarlo::Light light =
          row.what == "sky" ? air.sky(zenith, azimuth, 10000, 7) : air.above(zenith, azimuth, 10000, 7);
      worst = std::max(worst, std::abs(light.all - row.all) / std::hypot(light.error, row.error));
      if (turned_deg == 0.0) {
        EXPECT_NEAR(light.once / row.once, 1.0, 2e-3);
      }
    }
    return worst;
  };
  EXPECT_LT(off(0.0), 4.5);
  EXPECT_GT(off(0.2), 10.0) << "a Sun that is 0.2 degrees lower passes";
}

}  // namespace test_spherical_monte_carlo
