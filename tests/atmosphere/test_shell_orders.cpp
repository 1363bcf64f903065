#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/column_maker.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/scattering/shell_orders.h"
#include "atmosphere/spherical_shells.h"

// ShellOrders is used for ratios of two geometries, in which a common factor cancels: here each stands against a closed form.
namespace test_shell_orders {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr ShellOrders::Fineness kFine = {24, 12, 20.0};
constexpr double kThin = 1e-5;
/// Flat; round with a Sun that is as high all along a ray; round with a Sun that turns.
constexpr ShellOrders::Geometry kGeometries[] = {{false, false}, {true, false}, {true, true}};

ShellOrders orders(const Column& column, const ShellOrders::Geometry& geometry, double sun_deg) {
  ScatteringOptions options;
  options.most_sublayers = 1;
  const ScatteringColumn layers(column.levels, column.optics, sun_deg * kDegree, options);
  const std::vector<double> suns{(sun_deg - 1.0) * kDegree, sun_deg * kDegree, (sun_deg + 1.0) * kDegree};
  return {layers, geometry, suns, 1, kFine};
}
double flux_at_ground(const Column& column, const ShellOrders::Geometry& geometry, double sun_deg) {
  return std::exp(orders(column, geometry, sun_deg).log_flux().front());
}

/// Light that a thin shell scatters alike in all directions, on a square of the ground, of what it scatters above as much.
double seen_from_ground(double altitude_km) {
  const double ratio = kEarthRadius_km / (kEarthRadius_km + altitude_km);
  return 0.5 * (1.0 - std::sqrt(1.0 - ratio * ratio)) / (ratio * ratio);
}

/// Of light from straight above, the share that Henyey and Greenstein's function keeps going down.
double kept_going_down(double g) {
  return (1.0 - g * g) / (2.0 * g) * (1.0 / (1.0 - g) - 1.0 / std::sqrt(1.0 + g * g));
}

/// A layer of molecules or aerosol on the ground, 20 m thick.
Column low_layer(double rayleigh, double aerosol, double asymmetry) {
  Column column;
  column.add_layer(0.02, rayleigh, aerosol, asymmetry, 0.0);
  for (const double top_km : {2.0, 10.0, 60.0}) column.add_layer(top_km, 0.0, 0.0, 0.0, 0.0);
  return column;
}

}  // namespace

TEST(ShellOrders, HalfOfWhatMoleculesScatterOnceComesDown) {
  for (const ShellOrders::Geometry& geometry : kGeometries)
    for (const double sun_deg : {20.0, 60.0, 80.0})
      EXPECT_NEAR(flux_at_ground(low_layer(kThin, 0.0, 0.0), geometry, sun_deg) / kThin, 0.5, 0.002)
          << geometry.spherical << geometry.sun_turns << " " << sun_deg;
}

TEST(ShellOrders, HazeScattersOnceWhatItsMeanCosineSays) {
  for (const ShellOrders::Geometry& geometry : kGeometries)
    for (const double g : {0.2, 0.5}) {
      ASSERT_GT(kept_going_down(g), 0.5);
      // The Sun stands 1 degree from the zenith: what leaves the hemisphere by the one side enters it by the other.
      EXPECT_NEAR(flux_at_ground(low_layer(0.0, kThin, g), geometry, 1.0) / kThin, kept_going_down(g), 0.003)
          << geometry.spherical << geometry.sun_turns << " " << g;
    }
}

TEST(ShellOrders, AHighShellIsSeenFromAsManyDirectionsAsItFills) {
  for (const double low_km : {1.0, 8.0, 20.0}) {
    Column column;
    column.add_layer(low_km, 0.0, 0.0, 0.0, 0.0);
    column.add_layer(low_km + 0.1, 0.0, kThin, 0.0, 0.0);
    for (const double top_km : {30.0, 60.0}) column.add_layer(top_km, 0.0, 0.0, 0.0, 0.0);
    const double right = seen_from_ground(low_km + 0.05);
    EXPECT_NEAR(flux_at_ground(column, {true, false}, 40.0) / kThin / right, 1.0, 0.002) << low_km;
    EXPECT_NEAR(flux_at_ground(column, {true, true}, 40.0) / kThin / right, 1.0, 0.002) << low_km;
    EXPECT_LT(right, 0.495) << "flat layers pass";
  }
}

// Chapman (1931) of an exponential atmosphere and a Sun on the horizon: sqrt(pi x / 2) (1 + 3 / (8 x)), x radius over scale height.
TEST(ShellOrders, SunbeamsOnTheHorizonAreChapmans) {
  constexpr double kScale_km = 8.0, kDepth = 0.03;
  Column column = low_layer(kThin, 0.0, 0.0);
  column.optics.gas_absorption[0] = kDepth * -std::expm1(-0.02 / kScale_km);
  column.levels.altitude_km.resize(2), column.levels.pressure_hPa.resize(2);
  column.levels.temperature_K.resize(2);
  for (std::vector<double>* list :
       {&column.optics.rayleigh_scattering, &column.optics.aerosol_scattering, &column.optics.gas_absorption,
        &column.optics.aerosol_asymmetry, &column.optics.aerosol_absorption})
    list->resize(1);
  for (double low = 0.02; low < 90.0;) {
    const double high = low * 1.1 + 0.02;
    column.add_layer(high, 0.0, 0.0, 0.0,
                     kDepth * (std::exp(-low / kScale_km) - std::exp(-high / kScale_km)));
    low = high;
  }
  const double x = kEarthRadius_km / kScale_km, chapman = std::sqrt(0.5 * kPi * x) * (1.0 + 3.0 / (8.0 * x));
  const double through = std::exp(-kDepth * chapman), found = flux_at_ground(column, {true, false}, 90.0);
  EXPECT_NEAR(found / (0.5 * kThin * through), 1.0, 0.01);
  EXPECT_LT(through, 0.4) << "no beam at all passes";
}

namespace {

/// How far from each other net fluxes down through the levels lie, as a share of what is scattered: of a conservative column 0.
double loss(const Column& column, double sun_deg) {
  const ShellOrders light = orders(column, {false, false}, sun_deg);
  const std::size_t angles = 3, own = 1;
  const double mu = std::cos(sun_deg * kDegree);
  double least = 1e9, most = -1e9, beam_at_ground = 1.0;
  for (std::size_t z = 0; z < light.altitude_km().size(); ++z) {
    double depth = 0.0;
    for (std::size_t i = 0; i < column.optics.layers(); ++i)
      if (column.levels.altitude_km[i] >= light.altitude_km()[z] - 1e-9)
        depth += column.optics.rayleigh_scattering[i] + column.optics.aerosol_scattering[i] +
                 column.optics.aerosol_absorption[i];
    // Sunbeams come through shells, those of a high Sun as through flat layers.
    const double beam = std::exp(-depth / mu);
    if (z == 0) beam_at_ground = beam;
    const std::size_t at = z * angles + own;
    const double net = mu * beam + 4.0 * kPi * std::exp(light.log_mean()[at]) * light.up()[at];
    least = std::min(least, net), most = std::max(most, net);
  }
  return (most - least) / (mu * (1.0 - beam_at_ground));
}

Column layered(double rayleigh, double aerosol, double asymmetry, double absorbed) {
  Column column;
  constexpr int kLayers = 60;
  for (int i = 1; i <= kLayers; ++i)
    column.add_layer(0.5 * i, rayleigh / kLayers, aerosol / kLayers, asymmetry, 0.0, absorbed / kLayers);
  column.optics.depolarization = 0.0;
  return column;
}

}  // namespace

TEST(ShellOrders, WhatNothingAbsorbsComesOutAgain) {
  for (const double sun_deg : {20.0, 40.0}) {
    EXPECT_LT(loss(layered(0.5, 0.0, 0.0, 0.0), sun_deg), 0.007);
    EXPECT_LT(loss(layered(0.0, 0.5, 0.4, 0.0), sun_deg), 0.007);
    // A hundredth of every scattering missing, as an albedo has it, is seen.
    EXPECT_GT(loss(layered(0.5, 0.0, 0.0, 0.005), sun_deg), 0.015);
    EXPECT_GT(loss(layered(0.0, 0.5, 0.4, 0.005), sun_deg), 0.015);
  }
}

}  // namespace test_shell_orders
