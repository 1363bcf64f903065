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

namespace {

/// Depth of a sunbeam that ends at an altitude, straight through shells.
double beam_depth(const Column& column, double altitude_km, double sun_rad) {
  constexpr double kRadius_km = 6371.0;
  const double at = kRadius_km + altitude_km, along = at * std::cos(sun_rad), off = at * at - along * along;
  double depth = 0.0;
  for (std::size_t l = 0; l < column.levels.layers(); ++l) {
    const double low = std::max(at, kRadius_km + column.levels.altitude_km[l]),
                 high = kRadius_km + column.levels.altitude_km[l + 1];
    if (high <= low) continue;
    const double length = std::sqrt(high * high - off) - std::sqrt(low * low - off);
    depth += (column.optics.rayleigh_scattering[l] + column.optics.aerosol_scattering[l]) * length /
             (column.levels.altitude_km[l + 1] - column.levels.altitude_km[l]);
  }
  return depth;
}

/// What sunbeams leave in the air above a place, and what of them meets its ground.
double brought_in(const Column& column, double sun_rad) {
  double sum = std::cos(sun_rad) * std::exp(-beam_depth(column, 0.0, sun_rad));
  constexpr int kSteps = 100;
  for (std::size_t l = 0; l < column.levels.layers(); ++l) {
    const double low = column.levels.altitude_km[l], high = column.levels.altitude_km[l + 1];
    const double depth = column.optics.rayleigh_scattering[l] + column.optics.aerosol_scattering[l];
    for (int k = 0; k < kSteps; ++k)
      sum += depth / kSteps * std::exp(-beam_depth(column, low + (high - low) * (k + 0.5) / kSteps, sun_rad));
  }
  return sum;
}

}  // namespace

// About a round Earth more light comes to a place under a low Sun than falls on a level plane there: beams come in from beside,
// above where the Sun stands higher. What goes out is what beams bring, and what photons make of it.
TEST(SphericalMonteCarlo, LowSunsBringMoreThanFallsOnLevelGround) {
  Row row;
  row.haze = true;
  row.depth = 0.35;
  const Column column = column_of(row);
  for (const double sun_deg : {75.0, 85.0, 88.0}) {
    const double sun = sun_deg * kDegree;
    const FluxProfile fluxes = solved(column, sun_deg, true).sunlit().fluxes();
    const double down = fluxes.at(0.0).diffuse_down, direct = fluxes.direct_down.back(),
                 up = fluxes.up.front(), out = down + direct + up, in = brought_in(column, sun);
    SphericalMonteCarlo air(column.levels.altitude_km, column.optics.rayleigh_scattering, sun);
    air.add_haze(column.optics.aerosol_scattering, 0.65);
    const SphericalMonteCarlo::Light right_down = air.flux(40000, 5), right_up = air.flux_up(40000, 6);
    const double error = 3.0 * std::hypot(right_down.error, right_up.error);
    EXPECT_LT(std::abs(out - right_down.all - direct - right_up.all), 0.01 * out + error) << sun_deg;
    EXPECT_NEAR(out / in, 1.0, 0.01) << sun_deg;
  }
  const double low = 85.0 * kDegree;
  EXPECT_GT(brought_in(column, low), 1.08 * std::cos(low)) << "level ground alone would do";
}

}  // namespace test_spherical_monte_carlo
