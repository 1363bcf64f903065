#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column_maker.h"
#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/sky_ring.h"

namespace test_scattering_sky {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST(ScatteringSky, TheSkyAddsUpToItsFlux) {
  // Radiances have the exact phase function, fluxes the cut one; the aureole is in both.
  for (double asymmetry : {0.0, 0.65, 0.8}) {
    Air air;
    air.aerosol = 0.3;
    air.asymmetry = asymmetry;
    const Column column = air.column();
    const ColumnSolution solution = ColumnSolver(flat()).solve(column.levels, column.optics, 40.0 * kDegree);
    const GaussNodes nodes = gauss_nodes(64);
    double flux = 0.0, without_aureole = 0.0;
    constexpr int kAzimuths = 180;
    for (std::size_t j = 0; j < nodes.position.size(); ++j) {
      const SlantSource source = solution.sunlit().along(-nodes.position[j]);
      for (int k = 0; k < kAzimuths; ++k) {
        const double azimuth = kPi * (k + 0.5) / kAzimuths;
        const double part = 2.0 * kPi / kAzimuths * nodes.weight[j] * nodes.position[j] *
                            source.path(azimuth, 0.0).radiance().i;
        flux += part;
        const double cosine =
            scattering_cosine({-std::cos(40.0 * kDegree), 0.0}, {-nodes.position[j], azimuth});
        if (cosine < std::cos(15.0 * kDegree)) without_aureole += part;
      }
    }
    const double expected = solution.sunlit().fluxes().at(0.0).diffuse_down;
    EXPECT_NEAR(flux / expected, 1.0, 3e-3) << asymmetry;
    EXPECT_LT(without_aureole / expected, 0.97);
  }
}

TEST(ScatteringSky, ARingIsItsDirections) {
  Air air;
  air.aerosol = 0.3;
  air.asymmetry = 0.7;
  const Column column = air.column();
  constexpr double kAzimuths[] = {0.0, 0.3, 1.2, kPi};
  for (const bool polarized : {true, false}) {
    ScatteringOptions options;
    options.polarized = polarized;
    const ColumnSolution solution = ColumnSolver(options).solve(column.levels, column.optics, 1.0);
    for (const ScatteredField* field : {&solution.sunlit(), &solution.groundlit()})
      for (const double mu : {-1.0, -0.6, -0.01, 0.0})
        for (const double observer_km : {0.0, 0.7}) {
          const std::vector<double> ring = sky_ring(*field, mu, kAzimuths, observer_km);
          for (std::size_t a = 0; a < ring.size(); ++a)
            EXPECT_NEAR(ring[a] / field->sky({mu, kAzimuths[a]}, observer_km).radiance().i, 1.0, 1e-11)
                << mu << " " << kAzimuths[a];
        }
  }
}

TEST(ScatteringSky, TransferKeepsItsDigitsInThinAir) {
  for (const double depth : {1e-12, 1e-6, 0.01, 0.0624999, 0.0625001, 0.3, 3.0, 40.0}) {
    const long double d = depth, loss = -std::expm1(-d);
    const PathLoss found = PathLoss::over(depth);
    EXPECT_NEAR(found.loss / static_cast<double>(loss), 1.0, 1e-14) << depth;
    EXPECT_NEAR(found.mean / static_cast<double>(loss / d), 1.0, 1e-14) << depth;
    // The sum of (-d)^k / (k + 1)! from k = 1 on, as it stands.
    long double rest = 0.0L, term = 1.0L;
    for (int k = 1; k < 30; ++k) rest -= term *= -d / (k + 1);
    if (depth < 1.0) {
      EXPECT_NEAR(found.rest / static_cast<double>(rest), 1.0, 1e-13) << depth;
    }
  }
}

TEST(ScatteringSky, LowSunComesThroughShells) {
  // Depth along the beam by stepping through exponential air about a round Earth.
  Column column;
  constexpr int kLayers = 120;
  for (int i = 0; i < kLayers; ++i) {
    column.add_layer(0.5 * (i + 1), 0.1 * (std::exp(-i / 16.0) - std::exp(-(i + 1) / 16.0)), 0.0, 0.0, 0.0);
  }
  for (double zenith : {0.0, 60.0, 80.0, 88.0, 89.9}) {
    for (double altitude : {0.0, 10.0}) {
      const double c = std::cos(zenith * kDegree), r0 = 6371.0 + altitude;
      double depth = 0.0;
      for (double s = 0.05; s < 3000.0; s += 0.1) {
        const double z = std::sqrt(r0 * r0 + s * s + 2.0 * r0 * s * c) - 6371.0;
        if (z > 60.0) break;
        depth += 0.1 * 0.1 / 8.0 * std::exp(-z / 8.0);
      }
      ScatteringOptions options;
      const ScatteringColumn round(column.levels, column.optics, zenith * kDegree, options);
      const std::size_t level =
          static_cast<std::size_t>(std::find(round.altitude_km.begin(), round.altitude_km.end(), altitude) -
                                   round.altitude_km.begin());
      ASSERT_LT(level, round.beam_depth.size());
      EXPECT_NEAR(round.true_beam_depth[level] / depth, 1.0, 3e-3) << zenith << " " << altitude;
      options.spherical_earth = false;
      const ScatteringColumn plane(column.levels, column.optics, zenith * kDegree, options);
      if (zenith >= 80.0) {
        EXPECT_GT(plane.true_beam_depth[level] / depth, 1.03) << "flat layers pass for shells";
      }
    }
  }
}

TEST(ScatteringSky, SkyIsSeenThroughShells) {
  const Column column = Air().column();
  for (double zenith : {0.0, 60.0, 88.0, 89.99}) {
    const ColumnSolution solution = ColumnSolver().solve(column.levels, column.optics, zenith * kDegree);
    // The way to the Sun is as long for sight as for sunlight.
    for (double observer : {0.0, 1.0, 10.0}) {
      EXPECT_NEAR(solution.sunlit().sky({-std::cos(zenith * kDegree), 0.0}, observer).transmittance /
                      solution.sun_transmittance(observer),
                  1.0, 1e-9)
          << zenith << " " << observer;
    }
  }
  Air thin;
  thin.rayleigh = 0.005;
  thin.aerosol = thin.aerosol_absorption = 0.0;
  const ColumnSolution solution = ColumnSolver().solve(column.levels, thin.column().optics, 50.0 * kDegree);
  const auto ratio = [&](double mu) {
    return solution.sunlit().sky({-mu, 1.0}, 0.0).radiance().i /
           solution.sunlit().path({-mu, 1.0}, 0.0).radiance().i;
  };
  EXPECT_NEAR(ratio(1.0), 1.0, 1e-3);
  EXPECT_NEAR(ratio(0.3), 1.0, 0.02);
  EXPECT_LT(ratio(0.01), 0.8) << "flat layers pass for shells";
  const StokesVector horizon = solution.sunlit().sky({0.0, 1.0}, 0.0).radiance();
  EXPECT_TRUE(std::isfinite(horizon.i) && horizon.i > 0.0);
}

TEST(ScatteringSky, PathsJoin) {
  Air air;
  air.gas = 0.2;
  const Column column = air.column();
  const ColumnSolution solution = ColumnSolver().solve(column.levels, column.optics, 40.0 * kDegree);
  const double mu = 0.35, azimuth = 0.8;
  const SlantSource down = solution.sunlit().along(mu), up = solution.sunlit().along(-mu);
  const auto joined = [](const PathLight& near, const PathLight& far, const PathLight& whole) {
    const StokesVector sum = near.radiance() + near.peak_transmittance * far.radiance(),
                       expected = whole.radiance();
    EXPECT_NEAR(sum.i, expected.i, 1e-12 * expected.i);
    EXPECT_NEAR(sum.q, expected.q, 1e-12 * expected.i);
    EXPECT_NEAR(sum.u, expected.u, 1e-12 * expected.i);
    EXPECT_NEAR(near.transmittance * far.transmittance, whole.transmittance, 1e-13);
  };
  joined(down.path(azimuth, 7.3, 5.1 / mu), down.path(azimuth, 2.2), down.path(azimuth, 7.3));
  joined(up.path(azimuth, 0.4, 0.37 / mu), up.path(azimuth, 0.77), up.path(azimuth, 0.4));
  // Between two points of a scene, nearly level and level.
  const double level = solution.sunlit().path({0.0, azimuth}, 0.5, 8.0).radiance().i;
  for (double tilt : {1e-9, -1e-9}) {
    EXPECT_NEAR(solution.sunlit().path({tilt, azimuth}, 0.5, 8.0).radiance().i / level, 1.0, 1e-6);
  }
  EXPECT_GT(level, 0.0);
  EXPECT_EQ(solution.sunlit().path({-0.5, 0.0}, 70.0).radiance().i, 0.0) << "light from above the air";
}

TEST(ScatteringSky, AureoleIsBrightAndSideSkyIsPolarized) {
  const Column column = Air().column();
  const ColumnSolution solution = ColumnSolver().solve(column.levels, column.optics, 60.0 * kDegree);
  const auto sky = [&](double zenith, double azimuth) {
    return solution.sunlit().path({-std::cos(zenith * kDegree), azimuth * kDegree}, 0.0).radiance();
  };
  EXPECT_GT(sky(57.0, 0.0).i, 3.0 * sky(60.0, 90.0).i);
  const StokesVector side = sky(30.0, 180.0);
  EXPECT_GT(-side.q / side.i, 0.2) << "90 degrees from the Sun light swings across the Sun's vertical";
  EXPECT_NEAR(side.u / side.i, 0.0, 1e-12);
}

TEST(ScatteringSky, SkyHasItsNeutralPoints) {
  // Light scattered more often turns the polarization of the solar vertical over near the Sun and opposite to
  // it: the points of Babinet and Arago, some 20 degrees from the Sun and from the point opposite (Coulson
  // 1988).
  Air air;
  air.rayleigh = 0.25;
  air.aerosol = air.aerosol_absorption = 0.0;
  const Column column = air.column();
  constexpr double kElevation = 15.0;
  const ColumnSolution solution =
      ColumnSolver().solve(column.levels, column.optics, (90.0 - kElevation) * kDegree);
  // Elevation at which Q changes sign, upwards from a start; 90 where it does not.
  const auto neutral = [&](double azimuth, double start, bool once) {
    for (double elevation = start; elevation < 90.0; elevation += 0.25) {
      const PathLight light = solution.sunlit().sky({-std::sin(elevation * kDegree), azimuth * kDegree}, 0.0);
      if ((once ? light.single.q : light.radiance().q) < 0.0) return elevation;
    }
    return 90.0;
  };
  const double babinet = neutral(0.0, kElevation + 0.25, false) - kElevation;
  EXPECT_GT(babinet, 8.0);
  EXPECT_LT(babinet, 25.0);
  const double arago = neutral(180.0, 0.5, false) + kElevation;
  EXPECT_GT(arago, 16.5);
  EXPECT_LT(arago, 30.0);
  EXPECT_EQ(neutral(0.0, kElevation + 0.25, true), kElevation + 0.25)
      << "light scattered once has a neutral point";
}

}  // namespace test_scattering_sky
