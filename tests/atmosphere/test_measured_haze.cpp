// Haze by measured optics, in layers, mixtures and profiles.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <string>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/particles/given_particles.h"
#include "atmosphere/particles/measured_particles.h"
#include "atmosphere/particles/particle_layer.h"
#include "core/error.h"

namespace ifov::atmosphere::test_measured_haze {
namespace {

using radiometry::Spectrum;

double total(const std::vector<double>& depths) { return std::accumulate(depths.begin(), depths.end(), 0.0); }

std::shared_ptr<const Particles> grey(double albedo, double asymmetry) {
  return std::make_shared<const GivenParticles>(0.0, Spectrum::constant(albedo),
                                                Spectrum::constant(asymmetry));
}

AtmosphereColumn with(const std::vector<ParticleLayer>& layers) {
  AtmosphereDescription description;
  description.aerosol.stratosphere = "none";
  for (const ParticleLayer& layer : layers)
    description.aerosol.own.push_back(std::make_shared<const ParticleLayer>(layer));
  return AtmosphereColumn(description);
}

// Angstrom's law between and beyond what is measured; a grey pair is grey.
TEST(MeasuredHaze, IsAPowerOfWavelengthBetween) {
  const MeasuredParticles haze(
      {{0.44, 0.675, 1.02}, {0.4, 0.2, 0.2}, {0.9, 0.92, 0.96}, std::vector<double>{0.7, 0.66, 0.6}});
  const double a = std::log(0.4 / 0.2) / std::log(0.675 / 0.44);
  EXPECT_NEAR(haze.optical_depth(0.55), 0.4 * std::pow(0.55 / 0.44, -a), 1e-12);
  EXPECT_NEAR(haze.optical_depth(0.35), 0.4 * std::pow(0.35 / 0.44, -a), 1e-12);
  EXPECT_NEAR(haze.optical_depth(2.2), 0.2, 1e-12);
  const AerosolProperties middle = haze.properties(0.5575);
  EXPECT_NEAR(middle.absorption / middle.extinction, 1.0 - 0.91, 1e-12);
  EXPECT_NEAR(middle.asymmetry, 0.68, 1e-12);
  EXPECT_NEAR(haze.properties(2.2).asymmetry, 0.6, 1e-12);
  EXPECT_NEAR(haze.properties(0.55).extinction, 1.0, 1e-12);
  EXPECT_NEAR(haze.phase_function(2.2).moment(1), 0.6, 1e-3);
}

TEST(MeasuredHaze, WhatCannotBeIsTold) {
  const auto said = [](MeasuredParticles::Optics optics) {
    try {
      const MeasuredParticles haze(std::move(optics));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  const std::vector<double> g{0.7, 0.6};
  EXPECT_EQ(said({{0.44, 0.675}, {0.4, 0.2}, {0.9, 1.2}, g}),
            "a single-scattering albedo of 1.2 at 0.675 um: expected 0 to 1");
  EXPECT_EQ(said({{0.44, 0.675}, {0.4, 0.0}, {0.9, 0.9}, g}),
            "an optical depth of 0 at 0.675 um: expected above 0");
  EXPECT_EQ(said({{0.675, 0.44}, {0.4, 0.2}, {0.9, 0.9}, g}),
            "the wavelengths of measured haze must rise: found 0.44 um");
}

// Parts of a mixture add by optical depth: scattering, absorption, and the mean cosine weighted with what each scatters.
TEST(MeasuredHaze, AMixtureIsTheSumOfItsParts) {
  ParticleLayer smoke, dust;
  smoke.optical_depth = 0.3, smoke.particles = grey(0.8, 0.6), smoke.top_km = 2.0;
  dust.optical_depth = 0.5, dust.particles = grey(0.95, 0.75), dust.base_km = 1.0, dust.top_km = 4.0;
  const AtmosphereColumn air = with({smoke, dust});
  const LayerOptics layers = air.at(1e4 / 0.55).scattering;
  EXPECT_NEAR(total(layers.aerosol_scattering), 0.3 * 0.8 + 0.5 * 0.95, 1e-9);
  EXPECT_NEAR(total(layers.aerosol_absorption), 0.3 * 0.2 + 0.5 * 0.05, 1e-9);
  const std::vector<double>& km = air.levels().altitude_km;
  ASSERT_GT(layers.aerosol_scattering.size(), 20u);
  for (std::size_t l = 0; l < layers.aerosol_scattering.size(); ++l) {
    const double both = 0.15 * 0.8 + 0.5 / 3.0 * 0.95;  // scattered in a km where they meet
    const double middle = 0.5 * (km[l] + km[l + 1]), height = km[l + 1] - km[l];
    const double expected = middle < 1.0   ? 0.6
                            : middle < 2.0 ? (0.12 * 0.6 + (both - 0.12) * 0.75) / both
                            : middle < 4.0 ? 0.75
                                           : 0.0;
    EXPECT_NEAR(layers.aerosol_asymmetry[l], expected, 1e-9) << middle;
    if (middle > 1.0 && middle < 2.0) {
      EXPECT_NEAR(layers.aerosol_scattering[l], both * height, 1e-9);
    }
  }
}

// A table of densities: triangles and their areas by hand.
TEST(MeasuredHaze, AProfileHasItsAreas) {
  ParticleLayer layer;
  layer.optical_depth = 0.4;
  layer.particles = grey(1.0, 0.7);
  layer.heights = {{0.0, 3.0}, {1.0, 3.0}, {3.0, 0.0}, {4.0, 0.0}, {5.0, 2.0}};  // 3 + 3 + 0 + 1
  const LayerHeights heights(layer, 0.0);
  EXPECT_NEAR(heights.share(0.0, 1.0), 3.0 / 7.0, 1e-12);
  EXPECT_NEAR(heights.share(1.0, 2.0), 2.25 / 7.0, 1e-12);
  EXPECT_NEAR(heights.share(3.0, 4.0), 0.0, 1e-12);
  EXPECT_NEAR(heights.share(4.0, 100.0), 1.0 / 7.0, 1e-12);
  EXPECT_NEAR(heights.density(2.0), 1.5 / 7.0, 1e-12);
  const AtmosphereColumn air = with({layer});
  const LayerOptics layers = air.at(1e4 / 0.55).scattering;
  EXPECT_NEAR(total(layers.aerosol_scattering), 0.4, 1e-9);
  double low = 0.0;
  for (std::size_t l = 0; l < layers.aerosol_scattering.size(); ++l)
    if (air.levels().altitude_km[l + 1] < 1.0 + 1e-6) low += layers.aerosol_scattering[l];
  EXPECT_NEAR(low, 0.4 * 3.0 / 7.0, 1e-9);
  layer.heights = {{0.0, 0.0}, {2.0, 0.0}};
  EXPECT_THROW(with({layer}), InputError);
  layer.heights = {{2.0, 1.0}, {1.0, 1.0}};
  EXPECT_THROW(with({layer}), InputError);
}

}  // namespace
}  // namespace ifov::atmosphere::test_measured_haze
