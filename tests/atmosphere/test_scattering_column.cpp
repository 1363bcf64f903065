#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "atmosphere/column_maker.h"
#include "core/parallel.h"

namespace test_scattering_column {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSpace_km = 1e4;

/// Diffuse and direct flux that ground of radiance 1 sends through the column.
double transmitted_flux(const ColumnSolution& solution) {
  const ScatteringColumn& column = solution.sunlit().solved().column;
  double depth = 0.0;
  for (double part : column.depth) depth += part;
  const GaussNodes nodes = gauss_nodes(64);
  double direct = 0.0;
  for (std::size_t i = 0; i < nodes.position.size(); ++i) {
    direct += 2.0 * kPi * nodes.weight[i] * nodes.position[i] * std::exp(-depth / nodes.position[i]);
  }
  return direct + solution.groundlit().fluxes().up.front();
}

/// Albedo of air over Lambertian ground, for the Sun's light.
double albedo_with_ground(const ColumnSolution& solution, double sun_mu, double ground) {
  const FluxProfile& fluxes = solution.sunlit().fluxes();
  const double irradiance =
      (fluxes.direct_down.back() + fluxes.diffuse_down.back()) / (1.0 - ground * solution.spherical_albedo());
  return (fluxes.up.front() + ground * irradiance / kPi * transmitted_flux(solution)) / sun_mu;
}

}  // namespace

TEST(ScatteringColumn, SingleScatteringHasItsClosedForm) {
  // One layer and the same layer in many pieces, aerosol and absorption included; no delta-M (g = 0).
  const double rayleigh = 0.2, aerosol = 0.3, gas = 0.1, depth = 0.6, sun = 0.6;
  for (int pieces : {1, 7}) {
    Column column;
    for (int i = 0; i < pieces; ++i) {
      column.add_layer(2.0 * (i + 1) / pieces, rayleigh / pieces, aerosol / pieces, 0.0, gas / pieces);
    }
    column.optics.depolarization = 0.0;
    const ScatteringColumn sunlit(column.levels, column.optics, std::acos(sun), flat());
    for (double mu : {0.9, 0.3, 0.05}) {
      for (double azimuth : {0.0, 1.0, 3.0}) {
        for (double side : {1.0, -1.0}) {
          const Propagation direction{side * mu, azimuth};
          const double cosine =
              -sun * direction.mu + std::sqrt((1 - sun * sun) * (1 - mu * mu)) * std::cos(azimuth);
          const double phase = (rayleigh * 0.75 * (1.0 + cosine * cosine) + aerosol) / depth;
          const double expected =
              side > 0.0
                  ? phase / (4.0 * kPi) * sun / (sun + mu) * -std::expm1(-depth * (1.0 / sun + 1.0 / mu))
                  : phase / (4.0 * kPi) * sun / (sun - mu) * (std::exp(-depth / sun) - std::exp(-depth / mu));
          const PathLight light = single_scattering(sunlit, 0.0, direction, side > 0.0 ? kSpace_km : 0.0);
          EXPECT_NEAR(light.single.i / expected, 1.0, 1e-12) << direction.mu << " " << azimuth;
          EXPECT_NEAR(light.transmittance, std::exp(-depth / mu), 1e-14);
        }
      }
    }
  }
}

TEST(ScatteringColumn, ConservativeAirOverWhiteGroundReturnsAllLight) {
  for (double depth : {0.05, 0.5, 1.5}) {
    const Column column = rayleigh_layer(depth);
    for (double sun : {0.2, 0.7}) {
      const ColumnSolution solution =
          ColumnSolver(flat()).solve(column.levels, column.optics, std::acos(sun));
      EXPECT_NEAR(albedo_with_ground(solution, sun, 1.0), 1.0, 1e-3) << depth << " " << sun;
      EXPECT_NEAR(albedo_with_ground(solution, sun, 0.0) + (solution.sunlit().fluxes().direct_down.back() +
                                                            solution.sunlit().fluxes().diffuse_down.back()) /
                                                               sun,
                  1.0, 1e-3);
      // The planted fault: no light comes back from the air to the ground.
      const FluxProfile& fluxes = solution.sunlit().fluxes();
      const double once = fluxes.direct_down.back() + fluxes.diffuse_down.back();
      EXPECT_LT((fluxes.up.front() + once / kPi * transmitted_flux(solution)) / sun, 1.0 - 3e-3);
    }
  }
}

TEST(ScatteringColumn, AerosolConservesEnergy) {
  for (double asymmetry : {0.0, 0.65, 0.8, 0.9}) {
    for (double depth : {0.1, 1.0}) {
      Column column;
      column.add_layer(5.0, 0.05, depth, asymmetry, 0.0);
      const double sun = 0.6;
      const auto balance = [&](const LayerOptics& optics) {
        const ColumnSolution solution = ColumnSolver(flat()).solve(column.levels, optics, std::acos(sun));
        const FluxProfile& fluxes = solution.sunlit().fluxes();
        return (fluxes.up.front() + fluxes.direct_down.back() + fluxes.diffuse_down.back()) / sun;
      };
      EXPECT_NEAR(balance(column.optics), 1.0, 1e-3) << asymmetry << " " << depth;
      LayerOptics absorbing = column.optics;
      absorbing.aerosol_absorption[0] = 0.02 * depth;
      EXPECT_LT(balance(absorbing), 1.0 - 0.01 * depth);
    }
  }
}

TEST(ScatteringColumn, LightAndSunMayChangePlaces) {
  // Helmholtz: I(mu; mu0) / mu0 = I(mu0; mu) / mu, layers and polarization notwithstanding.
  Air air;
  air.gas = 0.1;
  const Column column = air.column();
  const auto radiance = [&](double view, double sun, double azimuth) {
    const ColumnSolution solution =
        ColumnSolver(flat(12, 0.005)).solve(column.levels, column.optics, std::acos(sun));
    return solution.sunlit().path({view, azimuth}, kSpace_km).radiance().i / sun;
  };
  for (double azimuth : {0.0, 1.2, 3.1}) {
    const double there = radiance(0.9, 0.4, azimuth), back = radiance(0.4, 0.9, azimuth);
    EXPECT_NEAR(there / back, 1.0, 3e-4) << azimuth;
    EXPECT_GT(std::abs(there * 0.4 / (back * 0.9) - 1.0), 0.3)
        << "the factor of the Sun's height has no effect";
  }
}

TEST(ScatteringColumn, GroundSeesTheSkyAsTheSkySeesTheGround) {
  // Diffuse transmittance towards mu equals the share of a sunbeam from mu that arrives as diffuse light.
  Air air;
  air.asymmetry = 0.7;
  air.gas = 0.05;
  const Column column = air.column();
  for (double mu : {1.0, 0.7, 0.3}) {
    const ColumnSolution solution =
        ColumnSolver(flat(12, 0.005)).solve(column.levels, column.optics, std::acos(mu));
    const double up = solution.diffuse_transmittance(mu, kSpace_km).i;
    EXPECT_NEAR(up * mu / solution.sunlit().fluxes().diffuse_down.back(), 1.0, 1e-3) << mu;
  }
}

TEST(ScatteringColumn, CutPeakAndExactSingleScatteringConverge) {
  // Radiances with 8 nodes against 24, of which delta-M has next to nothing to cut.
  Air air;
  air.aerosol = 0.3;
  air.asymmetry = 0.75;
  const Column column = air.column();
  ScatteringOptions options = flat(8, 0.01);
  const ColumnSolution coarse = ColumnSolver(options).solve(column.levels, column.optics, 50.0 * kDegree);
  const ColumnSolution fine =
      ColumnSolver(flat(24, 0.005)).solve(column.levels, column.optics, 50.0 * kDegree);
  double worst = 0.0, worst_without = 0.0;
  for (double mu : {0.95, 0.5, 0.2, -0.95, -0.5, -0.2}) {
    for (double azimuth : {0.6, 1.5, 3.0}) {
      const double observer = mu > 0.0 ? kSpace_km : 0.0;
      const PathLight a = coarse.sunlit().path({mu, azimuth}, observer),
                      b = fine.sunlit().path({mu, azimuth}, observer);
      worst = std::max(worst, std::abs(a.radiance().i / b.radiance().i - 1.0));
      worst_without = std::max(worst_without, std::abs(a.multiple.i / b.radiance().i - 1.0));
    }
  }
  EXPECT_LT(worst, 2e-3);
  EXPECT_GT(worst_without, 0.1);
  EXPECT_NEAR(coarse.spherical_albedo() / fine.spherical_albedo(), 1.0, 1e-3);
  EXPECT_NEAR(coarse.sunlit().fluxes().diffuse_down.back() / fine.sunlit().fluxes().diffuse_down.back(), 1.0,
              1e-3);
}

TEST(ScatteringColumn, NothingScattersNothing) {
  Column column;
  column.add_layer(1.0, 0.0, 0.0, 0.0, 0.0);
  column.add_layer(2.0, 0.0, 0.0, 0.0, 0.7);
  const ColumnSolution solution = ColumnSolver().solve(column.levels, column.optics, 0.5);
  EXPECT_EQ(solution.sunlit().path({0.5, 0.0}, 5.0).radiance().i, 0.0);
  EXPECT_EQ(solution.spherical_albedo(), 0.0);
  EXPECT_EQ(solution.diffuse_transmittance(0.5, 5.0).i, 0.0);
  EXPECT_NEAR(solution.sun_transmittance(1.0), std::exp(-0.7 / std::cos(0.5)), 1e-3);
  EXPECT_NEAR(solution.sunlit().path({0.5, 0.0}, 5.0).transmittance, std::exp(-1.4), 1e-14);
}

TEST(ScatteringColumn, OpaqueGasIsNoTrouble) {
  Air air;
  for (double gas : {30.0, 1e4, 1e8}) {
    air.gas = gas;
    const Column column = air.column();
    const ColumnSolution solution = ColumnSolver().solve(column.levels, column.optics, 70.0 * kDegree);
    for (double mu : {1.0, 0.1, -0.1, -1.0}) {
      const StokesVector light = solution.sunlit().path({mu, 1.0}, mu > 0.0 ? kSpace_km : 0.0).radiance();
      EXPECT_TRUE(std::isfinite(light.i) && std::isfinite(light.q) && light.i >= 0.0) << gas << " " << mu;
    }
    EXPECT_LT(solution.sunlit().fluxes().diffuse_down.back(), 1e-6);
  }
}

TEST(ScatteringColumn, AnyThreadGivesTheSameBytes) {
  const Column column = Air().column();
  const ColumnSolver solver;
  std::vector<double> results(8);
  ifov::parallel_for(8, 4, [&](std::int64_t i) {
    const ColumnSolution solution = solver.solve(column.levels, column.optics, 0.9);
    results[static_cast<std::size_t>(i)] = solution.sunlit().path({-0.3, 2.0}, 0.0).radiance().i;
  });
  for (double result : results) EXPECT_EQ(std::memcmp(&result, &results[0], sizeof result), 0);
}

TEST(ScatteringColumn, RefusesWhatDoesNotFit) {
  Column column = Air().column();
  const ColumnSolver solver;
  EXPECT_THROW(solver.solve(column.levels, column.optics, 1.8), std::invalid_argument) << "deep night";
  EXPECT_THROW(ColumnSolver(flat()).solve(column.levels, column.optics, 1.6), std::invalid_argument);
  column.optics.gas_absorption.pop_back();
  EXPECT_THROW(solver.solve(column.levels, column.optics, 0.5), std::invalid_argument);
  ScatteringOptions options;
  options.nodes_per_hemisphere = 1;
  EXPECT_THROW(ColumnSolver{options}, std::invalid_argument);
}

}  // namespace test_scattering_column
