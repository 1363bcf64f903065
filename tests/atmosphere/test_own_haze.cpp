#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/particles/aerosol_phase_functions.h"
#include "atmosphere/particles/given_particles.h"
#include "atmosphere/particles/particle_layer.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/single_scattering.h"
#include "column_maker.h"
#include "core/error.h"

namespace ifov::atmosphere::test_own_haze {
namespace {

using radiometry::Spectrum;
using test::kDegree;

std::shared_ptr<const GivenParticles> particles(double angstrom, double albedo, double asymmetry) {
  return std::make_shared<const GivenParticles>(angstrom, Spectrum::constant(albedo),
                                                Spectrum::constant(asymmetry));
}

ParticleLayer layer_of(double depth, std::shared_ptr<const Particles> of) {
  ParticleLayer layer;
  layer.optical_depth = depth;
  layer.particles = std::move(of);
  return layer;
}

AtmosphereDescription with_haze(const ParticleLayer& layer) {
  AtmosphereDescription description;
  description.aerosol.stratosphere = "none";
  description.aerosol.own = {std::make_shared<const ParticleLayer>(layer)};
  return description;
}

AtmosphereDescription own_haze(double depth, std::shared_ptr<const Particles> of) {
  return with_haze(layer_of(depth, std::move(of)));
}

double total(const std::vector<double>& depths) { return std::accumulate(depths.begin(), depths.end(), 0.0); }

double haze_depth(const LayerOptics& layers) {
  return total(layers.aerosol_scattering) + total(layers.aerosol_absorption);
}

/// The largest relative difference of skies and paths, and of fluxes.
double difference(const Levels& levels, const LayerOptics& a, const LayerOptics& b, bool polarized = false) {
  const ColumnSolver solver(test::flat(8, 0.05, polarized));
  const ColumnSolution one = solver.solve(levels, a, 50.0 * kDegree),
                       other = solver.solve(levels, b, 50.0 * kDegree);
  double worst = std::abs(one.sunlit().fluxes().up.front() / other.sunlit().fluxes().up.front() - 1.0);
  for (const double mu : {-0.9, -0.5, 0.4, 0.8, 1.0})
    for (const double azimuth : {0.3, 1.6, 3.0}) {
      const Propagation direction{mu, azimuth};
      const StokesVector first = one.sunlit().path(direction, mu > 0.0 ? 1e4 : 0.0).radiance(),
                         second = other.sunlit().path(direction, mu > 0.0 ? 1e4 : 0.0).radiance();
      worst = std::max(worst, std::abs(first.i - second.i) / second.i);
      if (!polarized) continue;
      worst =
          std::max(worst, std::max(std::abs(first.q - second.q), std::abs(first.u - second.u)) / second.i);
    }
  return worst;
}

/// A Henyey-Greenstein function and what a column has for it without a table.
LayerOptics by_asymmetry(LayerOptics layers, double asymmetry) {
  layers.aerosol_phases = nullptr;
  layers.aerosol_asymmetry.assign(layers.layers(), asymmetry);
  return layers;
}

std::string message(const AtmosphereDescription& description) {
  try {
    const AtmosphereColumn column(description);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

// The solver's own closed form of the function against the table that haze has. Planted: an asymmetry 1 % off.
TEST(OwnHaze, OfAnAsymmetryScattersAsTheSolverDoes) {
  const double asymmetry = 0.7;
  const AtmosphereColumn column(own_haze(0.4, particles(1.3, 0.92, asymmetry)));
  const LayerOptics layers = column.at(1e4 / 0.55).term(0);
  const double found = difference(column.levels(), layers, by_asymmetry(layers, asymmetry));
  RecordProperty("difference", std::to_string(found));
  EXPECT_LT(found, 2e-5);
  EXPECT_GT(difference(column.levels(), layers, by_asymmetry(layers, 0.99 * asymmetry)), 2e-3);
}

TEST(OwnHaze, OfAnAsymmetryHasItsMoments) {
  for (const double g : {-0.5, 0.0, 0.6, 0.9})
    for (const int l : {1, 2, 5, 16, 32})
      EXPECT_NEAR(henyey_greenstein(g).moment(l), std::pow(g, l), 1e-4) << g << " " << l;
}

TEST(OwnHaze, HasItsDepthItsShapeAndItsAlbedo) {
  ParticleLayer layer = layer_of(0.3, particles(1.4, 0.9, 0.65));
  layer.wavelength_um = 0.44;
  const AtmosphereColumn column(with_haze(layer));
  for (const double um : {0.35, 0.44, 0.865, 2.2, 10.0}) {
    const LayerOptics layers = column.at(1e4 / um).scattering;
    const double expected = 0.3 * std::pow(um / 0.44, -1.4);
    EXPECT_NEAR(haze_depth(layers) / expected, 1.0, 1e-12) << um;
    EXPECT_NEAR(total(layers.aerosol_absorption) / expected, 0.1, 1e-12) << um;
  }
  // Without heights: 2 km, of which the part below 2 km is 1 - 1/e.
  EXPECT_NEAR(column.aerosol().thickness_550(0.0, 2.0) / column.aerosol().thickness_550(0.0, 100.0),
              1.0 - std::exp(-1.0), 1e-12);
  EXPECT_NEAR(column.aerosol().extinction_550_km(4, 1.0) / column.aerosol().extinction_550_km(4, 3.0),
              std::exp(1.0), 1e-12);
}

// Levels stand at both ends, so that what lies between is all there, and nothing beside.
TEST(OwnHaze, LiesBetweenItsHeights) {
  ParticleLayer layer = layer_of(0.3, particles(0.0, 1.0, 0.65));
  layer.base_km = 1.13;
  layer.top_km = 2.71;
  const AtmosphereColumn column(with_haze(layer));
  const LayerOptics layers = column.at(1e4 / 0.55).scattering;
  double inside = 0.0;
  for (std::size_t l = 0; l < column.levels().layers(); ++l) {
    const double low = column.levels().altitude_km[l], high = column.levels().altitude_km[l + 1];
    const bool within = low >= 1.13 - 1e-9 && high <= 2.71 + 1e-9;
    if (within) inside += layers.aerosol_scattering[l];
    EXPECT_NEAR(layers.aerosol_scattering[l], within ? 0.3 * (high - low) / 1.58 : 0.0, 1e-12) << low;
  }
  EXPECT_NEAR(inside, 0.3, 1e-12);
}

// A level of the column's own a rounding error beside the haze's makes no layer of nothing.
TEST(OwnHaze, MakesNoLayersOfNothing) {
  ParticleLayer layer = layer_of(0.3, particles(0.0, 1.0, 0.65));
  layer.base_km = 1.05;
  layer.top_km = 2.05;
  AtmosphereDescription description = with_haze(layer);
  description.air.ground_altitude_km = 0.05;
  const AtmosphereColumn column(description);
  for (std::size_t l = 0; l < column.levels().layers(); ++l)
    EXPECT_GT(column.levels().altitude_km[l + 1] - column.levels().altitude_km[l], 0.01);
}

// Light scattered once by thin haze goes with its depth.
TEST(OwnHaze, ScattersWithItsDepth) {
  const auto light = [](double depth) {
    const AtmosphereColumn column(own_haze(depth, particles(1.3, 0.92, 0.7)));
    LayerOptics layers = column.at(1e4 / 0.55).scattering;
    layers.gas_absorption.assign(column.levels().layers(), 0.0);
    layers.rayleigh_scattering.assign(column.levels().layers(), 0.0);
    const ScatteringColumn lit(column.levels(), layers, 40.0 * kDegree, test::flat());
    return single_scattering(lit, 0.1, {0.8, 1.0}, 1e3).single;
  };
  EXPECT_NEAR(light(2e-4).i / light(1e-4).i, 2.0, 1e-3);
  EXPECT_NEAR(light(1e-4).q, 0.0, 1e-18) << "light of haze by an asymmetry is polarized";
}

// LOWTRAN7's function as a table of one's own: the same light as the built-in.
TEST(OwnHaze, OfATableScattersAsTheFunctionThatWasSampled) {
  const PhaseFunction rural = AerosolPhaseFunctions("rural", 80.0).at(0.55);
  const auto of_table = [&](const PhaseFunction& function) {
    const PhaseFunctionTable table{
        std::make_shared<const PhaseAngles>(function.angles().angle_rad), {0.55}, {function.logarithms()}};
    return std::make_shared<const GivenParticles>(1.3, Spectrum::constant(0.92), table);
  };
  const AtmosphereColumn column(own_haze(0.4, of_table(rural)));
  const LayerOptics layers = column.at(1e4 / 0.55).term(0);
  const auto built_in = [&](const PhaseFunction& function) {
    LayerOptics same = layers;
    const auto phases = std::make_shared<AerosolPhases>();
    phases->functions.push_back(function);
    phases->share.assign(layers.layers(), 1.0);
    same.aerosol_phases = phases;
    return same;
  };
  EXPECT_LT(difference(column.levels(), layers, built_in(rural)), 1e-9);
  EXPECT_GT(difference(column.levels(), layers, built_in(AerosolPhaseFunctions("rural", 70.0).at(0.55))),
            1e-3);
}

// Ratios of the shape that the solver assumes make what it makes; planted: Q turned round.
TEST(OwnHaze, PolarizesByItsRatios) {
  const double peak = 0.1;
  const PhaseFunction plain = henyey_greenstein(0.6);
  const auto with = [&](double sign) {
    PolarizationRatios ratios;
    for (const double angle : plain.angles().angle_rad) {
      const ScatteringMatrix matrix = particle_matrix(std::cos(angle), 1.0, sign * peak);
      ratios.a2.push_back(matrix.a2), ratios.a3.push_back(matrix.a3), ratios.b1.push_back(matrix.b1);
    }
    return PhaseFunction(std::make_shared<const PhaseAngles>(plain.angles().angle_rad), plain.logarithms(),
                         std::make_shared<const PolarizationRatios>(ratios));
  };
  const AtmosphereColumn column(own_haze(0.4, particles(1.3, 0.92, 0.6)));
  const auto layers = [&](const PhaseFunction& function) {
    LayerOptics same = column.at(1e4 / 0.55).term(0);
    const auto phases = std::make_shared<AerosolPhases>();
    phases->functions.push_back(function);
    phases->share.assign(same.layers(), 1.0);
    same.aerosol_phases = phases;
    return same;
  };
  const PhaseFunction assumed(std::make_shared<const PhaseAngles>(plain.angles().angle_rad),
                              plain.logarithms());
  EXPECT_LT(difference(column.levels(), layers(with(1.0)), layers(assumed), true), 2e-4);
  EXPECT_GT(difference(column.levels(), layers(with(-1.0)), layers(assumed), true), 0.02);
}

TEST(OwnHaze, StandsBesideTheStratosphere) {
  AtmosphereDescription description = own_haze(0.3, particles(1.3, 0.92, 0.7));
  description.aerosol.stratosphere = "background";
  const AtmosphereColumn column(description);
  AtmosphereDescription tables;
  const AtmosphereColumn usual(tables);
  EXPECT_EQ(column.aerosol().thickness_550(0, 0.0, 100.0), 0.0);
  EXPECT_EQ(column.aerosol().thickness_550(1, 0.0, 100.0), 0.0);
  EXPECT_NEAR(column.aerosol().thickness_550(2, 0.0, 100.0), usual.aerosol().thickness_550(2, 0.0, 100.0),
              1e-12);
  EXPECT_GT(column.aerosol().thickness_550(2, 0.0, 100.0), 0.003);
  EXPECT_NEAR(column.aerosol().thickness_550(4, 0.0, 100.0), 0.3, 1e-12);
}

TEST(OwnHaze, RefusesWhatCannotBe) {
  ParticleLayer layer = layer_of(0.3, particles(1.3, 0.92, 0.7));
  layer.base_km = 0.2;
  AtmosphereDescription description = with_haze(layer);
  description.air.ground_altitude_km = 1.5;
  EXPECT_EQ(message(description), "the haze begins at 0.2 km, inside the ground, which is at 1.5 km");
  layer.base_km = 3.0;
  layer.top_km = 120.0;
  EXPECT_EQ(message(with_haze(layer)), "the haze reaches to 120 km, above the air, which ends at 100 km");
  layer.top_km = 2.0;
  EXPECT_EQ(message(with_haze(layer)), "the haze ends at 2 km, not above its base at 3 km");
  description = own_haze(0.3, particles(1.3, 0.92, 0.7));
  description.aerosol.visibility_km = 23.0;
  EXPECT_EQ(message(description), "haze of one's own has an optical depth of its own, no visibility");
  EXPECT_EQ(message(own_haze(10.5, particles(1.3, 0.92, 0.7))),
            "optical depth 10.5 of the haze: expected 0 to 10");
  try {
    particles(1.0, 1.02, 0.7);
    FAIL() << "an albedo above 1 passes";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a single-scattering albedo of 1.02: expected 0 to 1");
  }
  EXPECT_THROW(particles(1.0, 0.9, 1.0), InputError);
}

}  // namespace ifov::atmosphere::test_own_haze
