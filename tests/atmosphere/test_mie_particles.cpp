#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/particles/mie_particles.h"
#include "atmosphere/particles/particle_layer.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/single_scattering.h"
#include "column_maker.h"
#include "core/error.h"
#include "radiometry/refractive_index.h"

namespace ifov::atmosphere::test_mie_particles {
namespace {

using radiometry::Spectrum;

MieParticles haze(double n = 1.45, double k = 0.005) {
  return MieParticles(lognormal(0.1, 1.8), Spectrum::constant(n), Spectrum::constant(k));
}

}  // namespace

// Between nodes what is interpolated is what the theory says there.
TEST(MieParticles, AreWhatTheTheorySaysBetweenNodes) {
  const MieParticles particles = haze();
  const PhaseAngles& angles = *mie_angles();
  std::vector<double> cosine;
  for (const double angle : angles.angle_rad) cosine.push_back(std::cos(angle));
  const double reference = mie_mixture(particles.sizes(), 0.55, {1.45, 0.005}, {}).extinction;
  for (const double um : {0.4137, 0.8650, 2.21}) {
    const MieMixture exact = mie_mixture(particles.sizes(), um, {1.45, 0.005}, cosine);
    const AerosolProperties properties = particles.properties(um);
    EXPECT_NEAR(properties.extinction / (exact.extinction / reference), 1.0, 2e-4) << um;
    EXPECT_NEAR(properties.absorption / ((exact.extinction - exact.scattering) / reference), 1.0, 2e-4) << um;
    EXPECT_NEAR(properties.asymmetry, exact.asymmetry, 2e-4) << um;
    const PhaseFunction function = particles.phase_function(um);
    EXPECT_NEAR(function.given_mean(), 1.0, 1e-3) << um;
    EXPECT_NEAR(function.moment(1), exact.asymmetry, 1e-3) << um;
    for (std::size_t k = 0; k < cosine.size(); k += 9) {
      const ScatteringMatrix matrix = function.matrix(cosine[k], 0.1);
      EXPECT_NEAR(matrix.a1 / exact.a1[k], 1.0, 5e-3) << um << " " << k;
      EXPECT_NEAR(matrix.b1 / matrix.a1, exact.b1[k] / exact.a1[k], 5e-3) << um << " " << k;
      EXPECT_NEAR(matrix.a3 / matrix.a1, exact.a3[k] / exact.a1[k], 5e-3) << um << " " << k;
    }
  }
}

// A column of spheres alone: light scattered once has the spheres' own degree of polarization, and by spheres much smaller
// than the wavelength that of molecules.
TEST(MieParticles, PolarizeAsTheyScatter) {
  const auto once = [](std::shared_ptr<const MieParticles> particles, double cosine_out) {
    AtmosphereDescription description;
    description.aerosol.stratosphere = "none";
    ParticleLayer layer;
    layer.optical_depth = 0.01;
    layer.particles = std::move(particles);
    description.aerosol.own = {std::make_shared<const ParticleLayer>(layer)};
    const AtmosphereColumn column(description);
    LayerOptics layers = column.at(1e4 / 0.55).scattering;
    layers.gas_absorption.assign(column.levels().layers(), 0.0);
    layers.rayleigh_scattering.assign(column.levels().layers(), 0.0);
    const ScatteringColumn lit(column.levels(), layers, 40.0 * test::kDegree, test::flat());
    return single_scattering(lit, 0.1, {cosine_out, 2.0}, 1e3).single;
  };
  const double cosine_out = 0.7,
               angle = scattering_cosine({-std::cos(40.0 * test::kDegree), 0.0}, {cosine_out, 2.0});
  const auto spheres = std::make_shared<const MieParticles>(lognormal(0.1, 1.8), Spectrum::constant(1.45),
                                                            Spectrum::constant(0.005));
  const StokesVector light = once(spheres, cosine_out);
  const ScatteringMatrix matrix = spheres->phase_function(0.55).matrix(angle, 0.1);
  EXPECT_NEAR(std::hypot(light.q, light.u) / light.i, std::abs(matrix.b1 / matrix.a1), 1e-9);
  EXPECT_GT(std::abs(matrix.b1 / matrix.a1 - particle_matrix(angle, 1.0, 0.1).b1), 0.02)
      << "the assumption passes";
  const auto small = std::make_shared<const MieParticles>(lognormal(2e-4, 1.2), Spectrum::constant(1.45),
                                                          Spectrum::constant(0.0));
  const StokesVector blue = once(small, cosine_out);
  EXPECT_NEAR(std::hypot(blue.q, blue.u) / blue.i, (1.0 - angle * angle) / (1.0 + angle * angle), 1e-3);
}

// Droplets of 10 um and water of the built-in table: extinction by volume is 3/4 Q / radius with Q near 2.
TEST(MieParticles, DropletsTakeTwiceTheirCrossSection) {
  const radiometry::RefractiveIndex& water = radiometry::refractive_index("water");
  const MieParticles droplets(gamma_by_effective_radius(10.0, 0.1), water.n, water.k);
  EXPECT_NEAR(droplets.extinction_per_volume(0.55) * 10.0 / 0.75, 2.09, 0.02);
  EXPECT_NEAR(droplets.properties(0.55).asymmetry, 0.862, 0.004);  // Hu and Stamnes 1993: 0.86
  EXPECT_LT(droplets.properties(0.55).absorption, 1e-5);
  EXPECT_GT(droplets.properties(11.0).absorption / droplets.properties(11.0).extinction, 0.45);
}

TEST(MieParticles, SayWhereTheirIndexEnds) {
  const Spectrum n({0.4, 1.0}, {1.4, 1.4}, radiometry::OutsideRange::error, "n of the haze");
  const MieParticles particles(lognormal(0.1, 1.8), n, Spectrum::constant(0.0));
  EXPECT_NO_THROW(particles.properties(0.9));
  EXPECT_THROW(particles.properties(1.2), InputError);
  EXPECT_THROW(haze(0.0), InputError);
  EXPECT_THROW(haze(1.4, -1e-3), InputError);
}

}  // namespace ifov::atmosphere::test_mie_particles
