#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "atmosphere/column_maker.h"
#include "atmosphere/scattering/round_earth_error.h"
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

TEST(CloudsRoundEarth, WhatIsStatedHoldsThem) {
  for (const double depth : {2.0, 10.0})
    for (const double sun_deg : {75.0, 80.0, 86.0, 89.0, 90.5, 92.0}) {
      const double stated = round_earth_error(sun_deg * kDegree, true).sky;
      EXPECT_LT(off_the_monte_carlo(depth, sun_deg), stated + 0.002) << depth << " " << sun_deg;
    }
  EXPECT_EQ(round_earth_error(60.0 * kDegree, true).sky, 0.0);
  EXPECT_GT(off_the_monte_carlo(10.0, 84.0, 0.9), round_earth_error(84.0 * kDegree, true).sky)
      << "a tenth less";
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

// A level Sun does not get through a cirrus of depth 0.3: all it scatters is scattered where the beam comes in.
TEST(CloudsRoundEarth, CirrusUnderALevelSunIsThatOfTheSphericalMonteCarlo) {
  const auto cirrus = [](int parts) {
    Column column;
    double low = 0.0;
    const auto add = [&](double high, double crystals) {
      column.add_layer(high, 0.05 * (std::exp(-low / 8.0) - std::exp(-high / 8.0)), crystals, 0.8, 0.0);
      low = high;
    };
    for (const double high : {0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) add(high, 0.0);
    for (int part = 1; part <= parts; ++part) add(9.0 + 2.0 * part / parts, 0.3 / parts);
    for (const double high : {12.0, 14.0, 16.0, 18.0, 20.0, 23.0, 26.0, 30.0, 35.0, 40.0, 50.0, 60.0})
      add(high, 0.0);
    column.optics.depolarization = 0.0;
    return column;
  };
  const auto flux = [&](int parts, double sun_deg) {
    return solve(cirrus(parts), sun_deg).sunlit().fluxes().at(0.0).diffuse_down;
  };
  for (const double sun_deg : {88.0, 89.0, 90.0, 90.5, 91.0, 92.0})
    EXPECT_NEAR(flux(1, sun_deg) / flux(8, sun_deg), 1.0, sun_deg < 89.5 ? 0.005 : 0.065) << sun_deg;
  for (const double sun_deg : {89.0, 90.5}) {
    const Column column = cirrus(8);
    SphericalMonteCarlo air(column.levels.altitude_km, column.optics.rayleigh_scattering, sun_deg * kDegree);
    air.add_haze(column.optics.aerosol_scattering, 0.8);
    const SphericalMonteCarlo::Light right = air.flux(50000, 5);
    EXPECT_NEAR(flux(1, sun_deg) / right.all, 1.0, 0.04 + 2.5 * right.error / right.all) << sun_deg;
  }
}

}  // namespace test_clouds_round_earth
