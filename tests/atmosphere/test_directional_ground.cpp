// Columns over ground that reflects by direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column_maker.h"
#include "atmosphere/ground_monte_carlo.h"
#include "atmosphere/scattering/ground/ground_modes.h"
#include "atmosphere/scattering/reflected_light.h"
#include "atmosphere/test_ground.h"

namespace test_directional_ground {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

constexpr double kPi = std::numbers::pi, kTop_km = 1e4, kSun = 0.6;

ColumnSolution solved(const ColumnSolver& solver, const Column& column, const DirectionalGround& ground,
                      double sun_mu) {
  const double zenith = std::acos(sun_mu);
  const GroundModes modes = solver.modes_of(ground, 0.55, zenith);
  return solver.solve(column.levels, column.optics, zenith, &modes);
}

/// What leaves the top of the air, with the light that comes straight from the ground.
StokesVector at_top(const ColumnSolution& solution, const Propagation& direction) {
  const ReflectedLight& ground = *solution.reflected();
  const double radiance = ground.exitance / kPi;
  const PathLight path = solution.sunlit().path(direction, kTop_km);
  return path.radiance() +
         radiance * (solution.reflected_transmittance(direction, kTop_km) +
                     path.transmittance * ground.shape.radiance(direction.mu, direction.azimuth_rad));
}

double rpv(double in, double out, double azimuth) { return rpv_of_paper(in, out, azimuth, 0.25, 0.7, -0.25); }

Column molecules_over_haze(double haze) {
  Column column;
  column.add_layer(2.0, 0.05, haze, 0.5, 0.0, 0.02);
  column.add_layer(10.0, 0.2, 0.0, 0.0, 0.0);
  column.optics.depolarization = 0.0;
  return column;
}
std::vector<MonteCarloLayer> the_same(double haze) { return {{0.2, 0.0, 0.0, 0.0}, {0.05, haze, 0.5, 0.02}}; }

const std::vector<std::array<double, 2>> kViews{{0.9, 0.0}, {0.5, 0.3}, {0.5, 1.6}, {0.8, kPi}, {0.35, 2.6}};

/// In standard errors of the Monte Carlo and 0.3 % of I, the largest difference of I (or of I, Q and U) over the views.
double worst_difference(const ColumnSolution& solution, const std::vector<MonteCarloLight>& reference,
                        bool polarized) {
  double worst = 0.0;
  for (std::size_t v = 0; v < kViews.size(); ++v) {
    const StokesVector light = at_top(solution, {kViews[v][0], kViews[v][1]});
    const double values[] = {light.i, light.q, light.u};
    for (std::size_t c = 0; c < (polarized ? 3u : 1u); ++c)
      worst = std::max(worst, std::abs(values[c] - reference[v].stokes[c]) /
                                  (4.0 * reference[v].error[c] + 0.003 * reference[v].stokes[0]));
  }
  return worst;
}

FormulaGround facet_ground(const GroundOfFields& facets, double sign_of_u = 1.0) {
  return {[facets, sign_of_u](const GroundEvent& e) {
            const Vector in = towards(e.in_mu, e.in_azimuth_rad), out = towards(e.out_mu, e.out_azimuth_rad);
            GroundMatrix matrix{};
            for (std::size_t column = 0; column < 3; ++column) {
              std::array<double, 3> unit{};
              unit[column] = 1.0;
              const std::array<double, 3> made = stokes_of(facets(dyad_of(unit, in), in, out), out);
              for (std::size_t row = 0; row < 3; ++row) matrix[row][column] = made[row];
            }
            matrix[2][0] *= sign_of_u;
            return matrix;
          },
          true};
}

}  // namespace

TEST(DirectionalGround, LambertianGroundIsThatOfTheCouplingTerms) {
  for (const double albedo : {0.05, 0.5, 1.0}) {
    const FormulaGround ground = scalar_ground([&](double, double, double) { return albedo / kPi; });
    const Column column = Air{}.column();
    ScatteringOptions options = flat();
    options.tolerance = 1e-11;
    const ColumnSolver solver(options);
    const ColumnSolution solution = solved(solver, column, ground, kSun);
    ASSERT_NE(solution.reflected(), nullptr);
    const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(0.0);
    const double exitance =
        albedo * (fluxes.direct_down + fluxes.diffuse_down) / (1.0 - albedo * solution.spherical_albedo());
    EXPECT_NEAR(solution.reflected()->exitance, exitance, 1e-9 * exitance) << albedo;
    EXPECT_NEAR(solution.reflected_albedo(), solution.spherical_albedo(), 1e-10);
    EXPECT_NEAR(solution.reflected_flux(3.0).up, solution.ground_flux(3.0).up, 1e-10);
    EXPECT_NEAR(solution.reflected_flux(3.0).down, solution.ground_flux(3.0).down, 1e-10);
    for (const double mu : {0.2, 0.6, 1.0})
      for (const double azimuth : {0.0, 1.0, 3.0}) {
        const StokesVector given = solution.reflected_transmittance({mu, azimuth}, 5.0),
                           wanted = solution.diffuse_transmittance(mu, 5.0);
        EXPECT_NEAR(given.i, wanted.i, 1e-9);
        EXPECT_NEAR(given.q, wanted.q, 1e-9);
        EXPECT_NEAR(given.u, 0.0, 1e-9);
      }
  }
}

TEST(DirectionalGround, VegetationUnderHazeIsThatOfMonteCarlo) {
  const auto reference = monte_carlo(the_same(0.2), kSun, unpolarizing(rpv), kViews, 400000, 11);
  ScatteringOptions options = flat();
  options.aerosol_polarization = 0.0;
  const ColumnSolver solver(options);
  const Column column = molecules_over_haze(0.2);
  EXPECT_LT(worst_difference(solved(solver, column, scalar_ground(rpv), kSun), reference, false), 1.0);

  // Planted faults: forwards for backwards, a mode alone, an albedo for a BRDF.
  const FormulaGround mirrored =
      scalar_ground([](double in, double out, double azimuth) { return rpv(in, out, azimuth + kPi); });
  EXPECT_GT(worst_difference(solved(solver, column, mirrored, kSun), reference, false), 5.0);
  const double zenith = std::acos(kSun);
  const GroundModes one(scalar_ground(rpv), 0.55, solver.nodes(), kSun, 1, true);
  EXPECT_GT(worst_difference(solver.solve(column.levels, column.optics, zenith, &one), reference, false),
            5.0);
  const double albedo = [&] {
    const GroundModes modes = solver.modes_of(scalar_ground(rpv), 0.55, zenith);
    return modes.exitance(modes.of_beam(0)) / kSun;
  }();
  const FormulaGround even = scalar_ground([&](double, double, double) { return albedo / kPi; });
  EXPECT_GT(worst_difference(solved(solver, column, even, kSun), reference, false), 5.0);
}

TEST(DirectionalGround, FacetsUnderMoleculesAreThoseOfMonteCarloWithPolarization) {
  const GroundOfFields facets = facets_of_fields(1.34, 0.06);
  const auto reference = monte_carlo(the_same(0.0), kSun, facets, kViews, 400000, 12);
  const ColumnSolver solver(flat());
  const Column column = molecules_over_haze(0.0);
  EXPECT_LT(worst_difference(solved(solver, column, facet_ground(facets), kSun), reference, true), 1.0);
  EXPECT_GT(worst_difference(solved(solver, column, facet_ground(facets, -1.0), kSun), reference, true), 5.0);
  // Unpolarized facets are as bright, and the air above them is not.
  const FormulaGround dull(
      [&](const GroundEvent& e) {
        GroundMatrix brdf[1], first{};
        facet_ground(facets).reflect(0.55, {&e, 1}, brdf);
        first[0][0] = brdf[0][0][0];
        return first;
      },
      false);
  EXPECT_GT(worst_difference(solved(solver, column, dull, kSun), reference, true), 5.0);
}

TEST(DirectionalGround, NothingIsLostBetweenLosslessAirAndGround) {
  // Reciprocal, and its azimuth moves light about without keeping any.
  const auto white = [](double in, double out, double azimuth) {
    return (1.0 + 0.9 * (1.0 - in) * (1.0 - out) * std::cos(azimuth)) / kPi;
  };
  for (const double factor : {1.0, 0.98}) {
    const FormulaGround ground = scalar_ground(
        [&](double in, double out, double azimuth) { return factor * white(in, out, azimuth); });
    Column column;
    column.add_layer(2.0, 0.05, 0.3, 0.6, 0.0);
    column.add_layer(10.0, 0.2, 0.0, 0.0, 0.0);
    const ColumnSolution solution = solved(ColumnSolver(flat()), column, ground, kSun);
    const double up = solution.sunlit().fluxes().up.front() +
                      solution.reflected()->exitance * solution.reflected_flux(kTop_km).up;
    if (factor == 1.0)
      EXPECT_NEAR(up, kSun, 1e-3 * kSun);
    else  // a planted loss of 2 %
      EXPECT_LT(up, kSun * (1.0 - 5e-3));
  }
}

TEST(DirectionalGround, LightAndSunMayChangePlaces) {
  const ColumnSolver solver(flat(12));
  const Column column = molecules_over_haze(0.2);
  const auto reflectance = [&](double sun, double view, double azimuth, const DirectionalGround& ground) {
    return at_top(solved(solver, column, ground, sun), {view, azimuth}).i * kPi / sun;
  };
  const FormulaGround land = scalar_ground(rpv);
  for (const double azimuth : {0.0, 1.3, kPi}) {
    const double there = reflectance(0.8, 0.4, azimuth, land), back = reflectance(0.4, 0.8, azimuth, land);
    EXPECT_NEAR(there, back, 1e-3 * back) << azimuth;
  }
  const FormulaGround one_way = scalar_ground(
      [](double in, double out, double azimuth) { return rpv(in, out, azimuth) * (0.5 + out); });
  EXPECT_GT(std::abs(reflectance(0.8, 0.4, 1.3, one_way) / reflectance(0.4, 0.8, 1.3, one_way) - 1.0), 0.05);
}

}  // namespace test_directional_ground
