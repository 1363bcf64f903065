#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

constexpr RoundEarthAir kUnderCloud{true, 0.2, 0.0};

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
      const double stated = round_earth_error(sun_deg * kDegree, kUnderCloud).sky;
      EXPECT_LT(off_the_monte_carlo(depth, sun_deg), stated + 0.002) << depth << " " << sun_deg;
    }
  EXPECT_EQ(round_earth_error(60.0 * kDegree, kUnderCloud).sky, 0.0);
  EXPECT_GT(off_the_monte_carlo(10.0, 84.0, 0.9), round_earth_error(84.0 * kDegree, kUnderCloud).sky)
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
    EXPECT_NEAR(flux(1, sun_deg) / flux(8, sun_deg), 1.0, sun_deg < 89.5 ? 0.005 : 0.04) << sun_deg;
  for (const double sun_deg : {89.0, 90.5}) {
    const Column column = cirrus(8);
    SphericalMonteCarlo air(column.levels.altitude_km, column.optics.rayleigh_scattering, sun_deg * kDegree);
    air.add_haze(column.optics.aerosol_scattering, 0.8);
    const SphericalMonteCarlo::Light right = air.flux(50000, 5);
    EXPECT_NEAR(flux(1, sun_deg) / right.all, 1.0, 0.04 + 2.5 * right.error / right.all) << sun_deg;
  }
}

// Where molecules scatter next to nothing, light at dusk is what grazes haze and clouds: nearly all of it is scattered just below
// their tops, where the depth of a level beam goes with the root of how far it came.
namespace {

struct DarkCase {
  const char* name;
  double base_km, top_km, depth, asymmetry, molecules, gas;
  bool cloudy;
};
constexpr DarkCase kDark[] = {{"cirrus at 1.6 um", 9.0, 11.0, 0.3, 0.8, 0.0013, 0.03, true},
                              {"thick cirrus at 1.6 um", 9.0, 11.0, 3.0, 0.8, 0.0013, 0.03, true},
                              {"droplets at 1.6 um", 2.0, 3.0, 5.0, 0.85, 0.0013, 0.03, true},
                              {"cirrus, red", 9.0, 11.0, 0.3, 0.8, 0.05, 0.0, true},
                              {"haze at 1.6 um", 0.0, 2.0, 1.0, 0.65, 0.0013, 0.03, false}};

/// Particles, which absorb a twentieth, in layers as a document's clouds have them, or in even `parts`.
Column dark_column(const DarkCase& air, int parts) {
  constexpr double kScattered = 0.95;
  std::vector<double> cuts{air.base_km, air.top_km};
  const double height = air.top_km - air.base_km;
  for (int part = 1; part < parts; ++part) cuts.push_back(air.base_km + height * part / parts);
  for (double step = 0.25, at = step; parts == 0 && at < 0.5 * air.depth; step *= 2.0, at += step)
    cuts.insert(cuts.end(), {air.base_km + height * at / air.depth, air.top_km - height * at / air.depth});
  for (const double z : {0.5,  1.0,  1.5,  2.0,  2.5,  3.0,  4.0,  5.0,  6.0,  7.0,  8.0,  9.0,  10.0,
                         11.0, 12.0, 14.0, 16.0, 18.0, 20.0, 23.0, 26.0, 30.0, 35.0, 40.0, 50.0, 60.0})
    if (z < air.base_km || z > air.top_km) cuts.push_back(z);
  std::sort(cuts.begin(), cuts.end());
  Column column;
  double low = 0.0;
  for (const double high : cuts) {
    if (!(high > 0.0)) continue;
    const double of_air = std::exp(-low / 8.0) - std::exp(-high / 8.0);
    const bool within = low >= air.base_km && high <= air.top_km;
    const double particles = within ? air.depth * (high - low) / height : 0.0;
    column.add_layer(high, air.molecules * of_air, kScattered * particles, air.asymmetry, air.gas * of_air,
                     (1.0 - kScattered) * particles);
    low = high;
  }
  column.optics.depolarization = 0.0;
  return column;
}

SphericalMonteCarlo photons_in(const Column& column, double sun_deg, double asymmetry) {
  SphericalMonteCarlo air(column.levels.altitude_km, column.optics.rayleigh_scattering, sun_deg * kDegree);
  air.add_haze(column.optics.aerosol_scattering, asymmetry);
  std::vector<double> absorbed = column.optics.gas_absorption;
  for (std::size_t k = 0; k < absorbed.size(); ++k) absorbed[k] += column.optics.aerosol_absorption[k];
  air.add_absorption(absorbed);
  return air;
}

double flux_down(const DarkCase& air, int parts, double sun_deg) {
  return solve(dark_column(air, parts), sun_deg).sunlit().fluxes().at(0.0).diffuse_down;
}

}  // namespace

TEST(CloudsRoundEarth, DarkChannelsAtDuskDoNotDependOnLayers) {
  for (const DarkCase& air : kDark)
    for (const double sun_deg : {91.0, 94.0})
      EXPECT_NEAR(flux_down(air, 1, sun_deg) / flux_down(air, 8, sun_deg), 1.0, 0.07)
          << air.name << " " << sun_deg;
}

TEST(CloudsRoundEarth, SunlightThatGrazesCirrusIsScatteredOnceAsPhotonsAre) {
  // Thin, and with a blunt phase function: what delta-M takes for unscattered is next to nothing.
  const DarkCase air{"cirrus", 9.0, 11.0, 0.3, 0.3, 0.0013, 0.0, true};
  const Column column = dark_column(air, 1);
  for (const double sun_deg : {89.5, 90.0, 90.5}) {
    constexpr double kZenith_deg = 60.0;
    const SphericalMonteCarlo::Light right =
        photons_in(column, sun_deg, air.asymmetry).sky(kZenith_deg * kDegree, 0.0, 200000, 3);
    const double once =
        solve(column, sun_deg).sunlit().sky({-std::cos(kZenith_deg * kDegree), 0.0}, 0.0).single.i;
    EXPECT_NEAR(once / right.once, 1.0, 0.05) << sun_deg;
  }
}

TEST(CloudsRoundEarth, WhatIsStatedHoldsDarkChannelsAtDusk) {
  for (const DarkCase& air : kDark)
    for (const double sun_deg : {90.0, 90.5, 92.0, 94.0}) {
      const SphericalMonteCarlo photons = photons_in(dark_column(air, 8), sun_deg, air.asymmetry);
      const SphericalMonteCarlo::Light right = photons.flux(20000, 5);
      const double found = flux_down(air, 0, sun_deg);
      const RoundEarthAir of{air.cloudy, air.molecules, air.depth};
      const double stated = round_earth_error(sun_deg * kDegree, of).sky;
      EXPECT_LT(std::abs(found - right.all) - 2.5 * right.error, (stated + 0.005) * found)
          << air.name << " " << sun_deg;
    }
  EXPECT_LT(round_earth_error(92.0 * kDegree, {false, 0.0013, 1.0}).sky, 0.02);
  EXPECT_LT(round_earth_error(90.0 * kDegree, kUnderCloud).sky, 0.1)
      << "skies that molecules light are known better";
}

// Single directions, back towards a Sun that is up, where what clouds scatter more often was sent up to a third too much of.
TEST(CloudsRoundEarth, PathsTowardsTheSunAreThoseOfPhotons) {
  constexpr double kZenith_deg = 75.0, kBack_rad = 3.1;
  for (const std::size_t which : {0, 2, 3})
    for (const double sun_deg : {80.0, 86.0}) {
      const DarkCase& air = kDark[which];
      const SphericalMonteCarlo::Light right = photons_in(dark_column(air, 8), sun_deg, air.asymmetry)
                                                   .above(kZenith_deg * kDegree, kBack_rad, 20000, 3);
      const double found = solve(dark_column(air, 0), sun_deg)
                               .sunlit()
                               .line_of_sight({std::cos(kZenith_deg * kDegree), kBack_rad}, 1e4, 0.0)
                               .radiance()
                               .i;
      const RoundEarthError stated =
          round_earth_error(sun_deg * kDegree, {air.cloudy, air.molecules, air.depth});
      EXPECT_LT(std::abs(found - right.all) - 2.5 * right.error, (stated.path + 0.005) * found)
          << air.name << " " << sun_deg;
    }
}

// What two terms of a pattern lack must be cut off alike in both geometries, and the edge of haze is a place where light changes.
TEST(CloudsRoundEarth, HazeUnderALowSunIsThatOfPhotons) {
  const DarkCase& air = kDark[4];
  const Column column = dark_column(air, 0);
  for (const double sun_deg : {80.0, 89.0}) {
    const SphericalMonteCarlo photons = photons_in(column, sun_deg, air.asymmetry);
    const SphericalMonteCarlo::Light right = photons.sky(0.0, 0.0, 100000, 5);
    const double found = solve(column, sun_deg).sunlit().sky({-1.0, 0.0}, 0.0).radiance().i;
    const auto off = [&](double factor) {
      return std::abs(factor * found / right.all - 1.0) - 2.5 * right.error / right.all;
    };
    EXPECT_LT(off(1.0), 0.005) << sun_deg;
    // What a pattern that is cut off in one geometry alone makes of it, and light between altitudes on both sides of the edge.
    EXPECT_GT(off(sun_deg < 85.0 ? 1.024 : 1.05), 0.005) << sun_deg;
  }
}

// Where the Sun of the place that a line of sight meets is not yet level light falls by a tenth in a twentieth of a degree, and comes
// from that side.
namespace {

double sky_over_photons(const DarkCase& air, double sun_deg, double zenith_deg, std::uint64_t paths) {
  const SphericalMonteCarlo::Light right =
      photons_in(dark_column(air, 8), sun_deg, air.asymmetry).sky(zenith_deg * kDegree, 0.0, paths, 4);
  EXPECT_LT(right.error, 0.1 * right.all);
  const double mu = -std::cos(zenith_deg * kDegree);
  return solve(dark_column(air, 0), sun_deg).sunlit().sky({mu, 0.0}, 0.0).radiance().i / right.all;
}

}  // namespace

TEST(CloudsRoundEarth, SkyAtSunsetUnderCirrusTurnsToTheSun) {
  // Spread as the column's own light it is 0.45, 0.62 and 0.64 of what photons say.
  EXPECT_NEAR(sky_over_photons(kDark[1], 90.0, 70.0, 40000), 0.9, 0.15);
  EXPECT_NEAR(sky_over_photons(kDark[0], 90.25, 80.0, 10000), 1.0, 0.1);
  EXPECT_NEAR(sky_over_photons(kDark[3], 90.5, 85.0, 10000), 0.85, 0.08);
  // Where light is linear across the edges of clouds the zenith is 1.6 and 1.8 times too bright.
  EXPECT_NEAR(sky_over_photons(kDark[0], 90.5, 0.0, 20000), 1.05, 0.15);
  EXPECT_NEAR(sky_over_photons(kDark[1], 90.25, 0.0, 20000), 1.0, 0.15);
}

TEST(CloudsRoundEarth, WhatIsStatedHoldsDirectionsAtDusk) {
  for (const std::size_t which : {0, 1, 3})
    for (const double sun_deg : {89.0, 90.5})
      for (const double azimuth : {0.0, 3.1}) {
        constexpr double kZenith_deg = 80.0;
        const DarkCase& air = kDark[which];
        const SphericalMonteCarlo photons = photons_in(dark_column(air, 8), sun_deg, air.asymmetry);
        const ScatteredField light = solve(dark_column(air, 0), sun_deg).sunlit();
        const RoundEarthError stated =
            round_earth_error(sun_deg * kDegree, {air.cloudy, air.molecules, air.depth});
        const double mu = std::cos(kZenith_deg * kDegree);
        const SphericalMonteCarlo::Light sky = photons.sky(kZenith_deg * kDegree, azimuth, 5000, 4),
                                         path = photons.above(kZenith_deg * kDegree, azimuth, 5000, 3);
        const double our_sky = light.sky({-mu, azimuth}, 0.0).radiance().i,
                     our_path = light.line_of_sight({mu, azimuth}, 1e4, 0.0).radiance().i;
        EXPECT_LT(std::abs(our_sky - sky.all) - 2.5 * sky.error, stated.sky * our_sky) << air.name << sun_deg;
        EXPECT_LT(std::abs(our_path - path.all) - 2.5 * path.error, stated.path * our_path)
            << air.name << sun_deg;
      }
  EXPECT_LT(round_earth_error(90.25 * kDegree, {true, 0.0013, 0.3}).sky, 1.0);
  EXPECT_LT(round_earth_error(90.25 * kDegree, {true, 0.0013, 0.3}).path, 0.3);
}

}  // namespace test_clouds_round_earth
