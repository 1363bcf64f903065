#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/thermal/emitted_light.h"
#include "atmosphere/thermal/thermal_column.h"
#include "atmosphere/thermal/thermal_scattering.h"
#include "column_maker.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere::test_thermal_scattering {
namespace {

using test::Column;
using test::flat;

constexpr double kPi = std::numbers::pi;
/// Layers so low that shells about the Earth are as good as flat.
constexpr double kLow_km = 0.01;

/// A homogeneous layer of many, thinner ones towards both sides.
Column layer(double depth, double albedo, double asymmetry) {
  Column column;
  std::vector<double> steps;
  for (double step = 0.05, sum = 0.0; sum < 0.5 * depth; step *= 1.5) {
    steps.push_back(std::min(step, 0.5 * depth - sum));
    sum += steps.back();
  }
  double at = 0.0;
  const auto add = [&](double step) {
    at += step;
    column.add_layer(kLow_km * at / depth, 0.0, step * albedo, asymmetry, 0.0, step * (1.0 - albedo));
  };
  for (const double step : steps) add(step);
  for (std::size_t k = steps.size(); k-- > 0;) add(steps[k]);
  return column;
}

/// Planck's radiance at the levels, linear in optical depth.
std::vector<double> linear(const Column& column, double ground, double top) {
  std::vector<double> planck;
  for (const double z : column.levels.altitude_km) planck.push_back(ground + (top - ground) * z / kLow_km);
  return planck;
}
std::vector<double> even(const Column& column) { return linear(column, 1.0, 1.0); }

/// The planted fault of all that follows: light that is emitted and not scattered, as absorption alone makes it.
struct Unscattered {
  std::vector<double> altitude, planck, depth;
  Unscattered(const Column& of, std::vector<double> emitted)
      : altitude(of.levels.altitude_km), planck(std::move(emitted)), depth(of.optics.aerosol_absorption) {
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += of.optics.gas_absorption[i];
  }
  double up(double mu) const {
    return ThermalColumn(altitude, planck, depth).line_of_sight(kLow_km, mu, 0.0).radiance;
  }
  double down(double mu) const { return ThermalColumn(altitude, planck, depth).sky(mu, 0.0); }
};

double flux(const EmittedLight& light, bool up) {
  const GaussNodes nodes = gauss_nodes(16);
  double sum = 0.0;
  for (std::size_t j = 0; j < nodes.position.size(); ++j) {
    const double mu = nodes.position[j];
    sum +=
        2.0 * kPi * nodes.weight[j] * mu * (up ? light.line_of_sight(kLow_km, mu, 0.0) : light.sky(mu, 0.0));
  }
  return sum;
}

/// Planck's radiance of a band of wavenumbers, W m-2 sr-1.
double band(double first_cm1, double last_cm1, double kelvin) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double nu = first_cm1 + (last_cm1 - first_cm1) * (k + 0.5) / kSteps, um = 1e4 / nu;
    sum += radiometry::planck_w_m2_sr_um(um, kelvin) * um / nu * (last_cm1 - first_cm1) / kSteps;
  }
  return sum;
}

}  // namespace

// Kirchhoff: what an isothermal layer sends into a direction is what it would absorb of a beam from there, which the solver of
// sunlight says by other means. Upwards for any layers, downwards for layers that are the same upside down.
TEST(ThermalScattering, EmitsWhatItWouldAbsorbOfABeam) {
  struct Case {
    double depth, albedo;
  };
  for (const auto& [depth, albedo] : {Case{0.05, 0.3}, Case{1.0, 0.9}, Case{20.0, 0.9}, Case{10.0, 0.97}})
    for (const double mu : {1.0, 0.15}) {
      const Column column = layer(depth, albedo, 0.8);
      const FluxProfile fluxes = ColumnSolver(flat(12, 0.01, false))
                                     .solve(column.levels, column.optics, std::acos(mu))
                                     .sunlit()
                                     .fluxes();
      const double absorbed =
          1.0 - (fluxes.up.front() + fluxes.diffuse_down.back() + fluxes.direct_down.back()) / mu;
      const EmittedLight light(column.levels, column.optics, even(column));
      EXPECT_NEAR(light.line_of_sight(kLow_km, mu, 0.0) / absorbed, 1.0, 4e-3)
          << depth << ' ' << albedo << ' ' << mu;
      EXPECT_NEAR(light.sky(mu, 0.0) / absorbed, 1.0, 4e-3) << depth << ' ' << albedo << ' ' << mu;
      if (depth < 1.0 || mu == 1.0) continue;
      EXPECT_GT(std::abs(Unscattered(column, even(column)).up(mu) / absorbed - 1.0), 0.04)
          << depth << ' ' << albedo << ' ' << mu;
    }
}

// The same with air of several kinds of particles and gas above grey ground as warm as the air: 1 - the reflectance of all.
TEST(ThermalScattering, GroundAndAirPassOnEachOthersLight) {
  constexpr double kAlbedo = 0.3;
  Column column;
  column.add_layer(0.2 * kLow_km, 0.0, 0.2, 0.7, 0.3, 0.05);
  column.add_layer(0.5 * kLow_km, 0.1, 0.0, 0.0, 0.02);
  column.add_layer(0.7 * kLow_km, 0.0, 3.0, 0.85, 0.1, 0.3);
  column.add_layer(kLow_km, 0.05, 0.1, 0.6, 0.2, 0.05);
  for (const double mu : {1.0, 0.4}) {
    const ColumnSolution solved =
        ColumnSolver(flat(16, 0.005, false)).solve(column.levels, column.optics, std::acos(mu));
    const double albedo = solved.spherical_albedo();
    const FluxProfile& sunlit = solved.sunlit().fluxes();
    double straight = 0.0, depth = 0.0;
    for (std::size_t i = 0; i < column.optics.layers(); ++i)
      depth += column.optics.rayleigh_scattering[i] + column.optics.aerosol_scattering[i] +
               column.optics.gas_absorption[i] + column.optics.aerosol_absorption[i];
    const ScatteringColumn& scaled = solved.sunlit().solved().column;
    double scaled_depth = 0.0;
    for (const double part : scaled.depth) scaled_depth += part;
    const GaussNodes nodes = gauss_nodes(32);
    for (std::size_t j = 0; j < nodes.position.size(); ++j)
      straight +=
          2.0 * kPi * nodes.weight[j] * nodes.position[j] * std::exp(-scaled_depth / nodes.position[j]);
    const double on_ground =
        (sunlit.diffuse_down.back() + sunlit.direct_down.back()) / (1.0 - kAlbedo * albedo);
    const double reflected =
        sunlit.up.front() + kAlbedo * on_ground / kPi * (solved.groundlit().fluxes().up.front() + straight);
    const EmittedLight light(column.levels, column.optics, even(column));
    const double leaving =
        ((1.0 - kAlbedo) + kAlbedo * light.irradiance(0.0) / kPi) / (1.0 - kAlbedo * albedo);
    const double up = light.line_of_sight(kLow_km, mu, 0.0) +
                      leaving * (std::exp(-depth / mu) + solved.diffuse_transmittance(mu, kLow_km).i);
    EXPECT_NEAR(up, 1.0 - reflected / mu, 1e-3) << mu;
  }
}

// Chandrasekhar (1950), Radiative Transfer, ch. V: an endless isothermal atmosphere that scatters evenly sends sqrt(1 - a) H(mu),
// with H(mu) = 1 + mu H(mu) a/2 int H(x) / (mu + x) dx.
TEST(ThermalScattering, EndlessIsotropicAirHasChandrasekharsEmissivity) {
  const GaussNodes nodes = gauss_nodes(40);
  for (const double albedo : {0.5, 0.9, 0.99}) {
    std::vector<double> h(nodes.position.size(), 1.0);
    const auto at = [&](double mu) {
      double sum = 0.0;
      for (std::size_t k = 0; k < h.size(); ++k)
        sum += nodes.weight[k] * h[k] * nodes.position[k] / (mu + nodes.position[k]);
      return 1.0 / (std::sqrt(1.0 - albedo) + 0.5 * albedo * sum);
    };
    for (int step = 0; step < 400; ++step) {
      std::vector<double> next;
      for (const double mu : nodes.position) next.push_back(at(mu));
      h = next;
    }
    const Column column = layer(albedo > 0.95 ? 300.0 : 100.0, albedo, 0.0);
    const EmittedLight light(column.levels, column.optics, even(column), flat(8, 0.01, false));
    for (const double mu : {1.0, 0.6, 0.2, 0.05}) {
      const double expected = std::sqrt(1.0 - albedo) * at(mu);
      EXPECT_NEAR(light.line_of_sight(kLow_km, mu, 0.0) / expected, 1.0, 2e-3) << albedo << ' ' << mu;
    }
    EXPECT_GT(Unscattered(column, even(column)).up(1.0) / (std::sqrt(1.0 - albedo) * at(1.0)), 1.02);
  }
}

// Kylling and Stamnes (1992, J. Comp. Phys. 102, 265), table II, with the digits of DISORT's tests 7a and 7b: B linear in optical
// depth from 200 K at the top to 300 K below, in 300 to 800 cm-1 and at 2703 cm-1 (there 0.02 cm-1 wide); W m-2, W m-2 sr-1.
TEST(ThermalScattering, FluxesOfKyllingAndStamnes) {
  const Column thin = layer(1.0, 0.1, 0.05);
  const EmittedLight wide(thin.levels, thin.optics,
                          linear(thin, band(300.0, 800.0, 300.0), band(300.0, 800.0, 200.0)));
  EXPECT_NEAR(flux(wide, false) / 121.204, 1.0, 1e-3);
  EXPECT_NEAR(flux(wide, true) / 86.2936, 1.0, 1e-3);
  const Column thick = layer(100.0, 0.95, 0.75);
  const std::vector<double> planck =
      linear(thick, band(2702.99, 2703.01, 300.0), band(2702.99, 2703.01, 200.0));
  const EmittedLight narrow(thick.levels, thick.optics, planck);
  EXPECT_NEAR(flux(narrow, false) / 2.07786e-5, 1.0, 2e-3);
  EXPECT_NEAR(flux(narrow, true) / 1.10949e-6, 1.0, 2e-3);
  EXPECT_NEAR(narrow.line_of_sight(kLow_km, 1.0, 0.0) / 4.65744e-7, 1.0, 2e-3);
  EXPECT_NEAR(narrow.sky(1.0, 0.0) / 7.52311e-6, 1.0, 2e-3);
  EXPECT_GT(std::abs(Unscattered(thick, planck).down(1.0) / 7.52311e-6 - 1.0), 0.1);
}

// DISORT's test 7c: a beam of 200 W m-2 at 60 degrees, 100 W m-2 sr-1 and a black body of 100 K above, black ground of 320 K, one
// layer of depth 1, albedo 0.5, asymmetry 0.8 from 300 K above to 200 K below; all wavelengths. The sum of what each part makes.
TEST(ThermalScattering, BesideABeamAndGround) {
  const auto all = [](double kelvin) { return 5.670374e-8 * std::pow(kelvin, 4) / kPi; };
  const Column column = layer(1.0, 0.5, 0.8);
  const ColumnSolution solved =
      ColumnSolver(flat(8, 0.005, false)).solve(column.levels, column.optics, kPi / 3.0);
  const FluxProfile &sun = solved.sunlit().fluxes(), &ground = solved.groundlit().fluxes();
  const EmittedLight light(column.levels, column.optics, linear(column, all(200.0), all(300.0)));
  double straight = 0.0, depth = 0.0;
  for (const double part : solved.sunlit().solved().column.depth) depth += part;
  const GaussNodes nodes = gauss_nodes(32);
  for (std::size_t j = 0; j < nodes.position.size(); ++j)
    straight += 2.0 * kPi * nodes.weight[j] * nodes.position[j] * std::exp(-depth / nodes.position[j]);
  // The layer is the same upside down: what light from above does, light of the ground tells.
  const double through = ground.up.front() + straight, back = ground.diffuse_down.back();
  const double above = 100.0 + all(100.0), below = all(320.0);
  EXPECT_NEAR((flux(light, true) + 200.0 * sun.up.front() + below * through + above * back) / 429.572, 1.0,
              1e-3);
  EXPECT_NEAR(
      (flux(light, false) + 200.0 * sun.diffuse_down.back() + below * back + above * through) / 301.334, 1.0,
      1e-3);
}

// Finer layers, more angles and orders change little; and what scatters next to nothing is as it was without.
TEST(ThermalScattering, UsualOptionsAreFineEnough) {
  const Column column = layer(30.0, 0.9, 0.85);
  const std::vector<double> planck = linear(column, 2.0, 1.0);
  const EmittedLight usual(column.levels, column.optics, planck),
      careful(column.levels, column.optics, planck, flat(16, 0.002, false));
  for (const double mu : {1.0, 0.5, 0.1}) {
    EXPECT_NEAR(usual.line_of_sight(kLow_km, mu, 0.0) / careful.line_of_sight(kLow_km, mu, 0.0), 1.0, 2e-3)
        << mu;
    EXPECT_NEAR(usual.sky(mu, 0.0) / careful.sky(mu, 0.0), 1.0, 2e-3) << mu;
  }
  Column clear;
  clear.add_layer(1.0, 3e-4, 0.0, 0.0, 0.4);
  EXPECT_FALSE(scatters_own_light(clear.optics));
  const std::vector<double> glow{2.0, 1.0};
  const ThermalColumn straight(clear.levels.altitude_km, glow, clear.optics.gas_absorption);
  EXPECT_EQ(EmittedLight(clear.levels, clear.optics, glow).sky(0.5, 0.0), straight.sky(0.5, 0.0));
}

}  // namespace ifov::atmosphere::test_thermal_scattering
