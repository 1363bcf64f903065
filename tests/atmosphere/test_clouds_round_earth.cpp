#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "atmosphere/column_maker.h"
#include "atmosphere/scattering/round_earth_light.h"
#include "support/spherical_monte_carlo.h"

// Under a thick cloud the ratio of a round Earth to flat layers comes of orders of scattering that no simpler problem follows to
// their end.
namespace test_clouds_round_earth {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;
using ifov::test::SphericalMonteCarlo;

namespace {

/// Molecules of depth 0.2, and droplets between 1 and 2 km in `parts` layers.
Column cloudy(double depth, int parts) {
  const auto molecules = [](double low, double high) {
    return 0.2 * (std::exp(-low / 8.0) - std::exp(-high / 8.0));
  };
  Column column;
  double low = 0.0;
  const auto add = [&](double high, double droplets) {
    column.add_layer(high, molecules(low, high), droplets, 0.85, 0.0);
    low = high;
  };
  for (const double high : {0.5, 1.0}) add(high, 0.0);
  for (int part = 1; part <= parts; ++part) add(1.0 + static_cast<double>(part) / parts, depth / parts);
  for (const double high : {2.5,  3.0,  4.0,  5.0,  6.0,  7.0,  8.0,  9.0,  10.0, 11.0, 12.0,
                            14.0, 16.0, 18.0, 20.0, 23.0, 26.0, 30.0, 35.0, 40.0, 50.0, 60.0})
    add(high, 0.0);
  column.optics.depolarization = 0.0;
  return column;
}

ColumnSolution solve(const Column& column, double sun_deg) {
  ScatteringOptions options;
  options.polarized = false;
  return ColumnSolver(options).solve(column.levels, column.optics, sun_deg * kDegree);
}

double off_the_monte_carlo(double depth, double sun_deg, double factor = 1.0) {
  const Column column = cloudy(depth, 10);
  SphericalMonteCarlo air(column.levels.altitude_km, column.optics.rayleigh_scattering, sun_deg * kDegree);
  air.add_haze(column.optics.aerosol_scattering, 0.85);
  const SphericalMonteCarlo::Light right = air.flux(20000, 5);
  const double found = factor * solve(column, sun_deg).sunlit().fluxes().at(0.0).diffuse_down;
  return std::abs(found / right.all - 1.0) - 2.5 * right.error / right.all;
}

}  // namespace

TEST(CloudsRoundEarth, LightBelowThemIsThatOfTheSphericalMonteCarlo) {
  for (const double depth : {2.0, 10.0})
    for (const double sun_deg : {75.0, 84.0, 89.0})
      EXPECT_LT(off_the_monte_carlo(depth, sun_deg), 0.02) << depth << " " << sun_deg;
  EXPECT_LT(off_the_monte_carlo(10.0, 92.0), 0.04);
  EXPECT_GT(off_the_monte_carlo(10.0, 84.0, 0.9), 0.02) << "a tenth less passes";
}

TEST(CloudsRoundEarth, TheirLayersDoNotCount) {
  for (const double sun_deg : {60.0, 75.0, 80.0, 86.0}) {
    const auto light = [&](int parts) { return solve(cloudy(10.0, parts), sun_deg).sunlit(); };
    const ScatteredField few = light(10), many = light(40);
    EXPECT_NEAR(few.fluxes().at(0.0).diffuse_down / many.fluxes().at(0.0).diffuse_down, 1.0, 0.01) << sun_deg;
    const auto path = [](const ScatteredField& field) {
      return field.line_of_sight({0.8, 1.0}, 1e4, 0.0).radiance().i;
    };
    EXPECT_NEAR(path(few) / path(many), 1.0, 0.015) << sun_deg;
    // Within a cloud no ray goes so far that the Earth is round over it.
    const RoundEarthLight ratio(few.solved().column);
    EXPECT_NEAR(ratio.flux_ratio().back(), 1.0, 0.05) << sun_deg;
  }
}

TEST(Scratch, Cirrus) {
  for (const double sun : {86.0, 88.0, 89.0, 90.0, 90.5, 91.0, 92.0})
    for (const int parts : {1, 8}) {
      const auto molecules = [](double low, double high) { return 0.05 * (std::exp(-low / 8.0) - std::exp(-high / 8.0)); };
      Column c; double low = 0;
      for (double z : {0.25, .5, 1., 1.5, 2., 3., 4., 5., 6., 7., 8., 9.}) c.add_layer(z, molecules(low, z), 0, 0, 0), low = z;
      for (int p = 1; p <= parts; ++p) { const double z = 9 + 2.0 * p / parts; c.add_layer(z, molecules(low, z), .3 / parts, .8, 0), low = z; }
      for (double z : {12., 14., 16., 18., 20., 23., 26., 30., 35., 40., 50., 60.}) c.add_layer(z, molecules(low, z), 0, 0, 0), low = z;
      c.optics.depolarization = 0.0;
      const ColumnSolution s = solve(c, sun);
      SphericalMonteCarlo air(c.levels.altitude_km, c.optics.rayleigh_scattering, sun * kDegree);
      air.add_haze(c.optics.aerosol_scattering, .8);
      const auto mc = parts == 8 ? air.flux(100000, 5) : SphericalMonteCarlo::Light{1, 1, 1};
      printf("sun %g parts %d down %.6f mc %.6f off %.2f%% se %.2f%% ratio %.4f\n", sun, parts, s.sunlit().fluxes().at(0.0).diffuse_down, mc.all, 100 * (s.sunlit().fluxes().at(0.0).diffuse_down / mc.all - 1), 100 * mc.error / mc.all, RoundEarthLight(s.sunlit().solved().column).flux_ratio().back());
    }
}
}  // namespace test_clouds_round_earth
