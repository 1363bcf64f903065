#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/scattering/ground_spread.h"
#include "atmosphere/scattering/phase/phase_function.h"
#include "core/format.h"
#include "math/angle.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/spherical_rows.h"

namespace ifov::studies {
namespace {

using namespace atmosphere;

/// The columns of the reference: 34 layers to 60 km, molecules of scale height 8 km, haze of 1.5 km.
ColumnSolution solved_shells(const SphericalRow& row) {
  Levels levels{{0.0}, {1013.0}, {288.0}};
  LayerOptics optics;
  const auto share = [](double low, double high, double scale) {
    return (std::exp(-low / scale) - std::exp(-high / scale)) / -std::expm1(-60.0 / scale);
  };
  for (int k = 0; k < 34; ++k) {
    const double low = levels.altitude_km.back(), high = low + (low < 25.0 ? 1.0 : 35.0 / 9.0);
    levels.altitude_km.push_back(high);
    levels.pressure_hPa.push_back(1013.0 * std::exp(-high / 8.0));
    levels.temperature_K.push_back(250.0);
    optics.rayleigh_scattering.push_back(row.depth * share(low, high, 8.0));
    optics.aerosol_scattering.push_back(row.haze ? 0.2 * share(low, high, 1.5) : 0.0);
    optics.aerosol_asymmetry.push_back(0.65);
    optics.gas_absorption.push_back(0.0);
    optics.aerosol_absorption.push_back(0.0);
  }
  optics.depolarization = 0.0;
  ScatteringOptions options;
  options.polarized = false;
  return ColumnSolver(options).solve(levels, optics, row.sun * math::kDegree);
}

/// Relative, beyond 2.5 standard errors of the reference.
double off_by(const ColumnSolution& solution, const SphericalRow& row) {
  const double mu = std::cos(row.zenith * math::kDegree), azimuth = row.azimuth * math::kDegree;
  const double found = row.what == SphericalRow::flux ? solution.sunlit().fluxes().at(0.0).diffuse_down
                       : row.what == SphericalRow::sky
                           ? solution.sunlit().sky({-mu, azimuth}, 0.0).radiance().i
                           : solution.sunlit().line_of_sight({mu, azimuth}, 1e4, 0.0).radiance().i;
  return 100.0 * std::max(0.0, std::abs(found / row.light - 1.0) - 2.5 * row.error / row.light);
}

void add_spherical(AtmosphereSection& section) {
  std::map<std::tuple<bool, double, double>, std::unique_ptr<ColumnSolution>> solutions;
  double clear = 0.0, clear_low = 0.0, hazy = 0.0, hazy_sky = 0.0, hazy_flux = 0.0, twilight = 0.0;
  for (const SphericalRow& row : kSphericalRows) {
    auto& solution = solutions[{row.haze, row.depth, row.sun}];
    if (!solution) solution = std::make_unique<ColumnSolution>(solved_shells(row));
    double& worst = row.sun > 90.0                                    ? twilight
                    : row.what == SphericalRow::flux                  ? hazy_flux
                    : !row.haze                                       ? row.sun > 87.0 ? clear_low : clear
                    : row.what == SphericalRow::sky && row.sun > 87.0 ? hazy_sky
                                                                      : hazy;
    worst = std::max(worst, off_by(*solution, row));
  }
  section.figures.at_most(
      "spherical_to_87", clear, 1.5, "%",
      "molecules of depth 0.1 and 0.35, skies and lines of sight to 80 degrees, Sun at 84 and 87 degrees");
  section.figures.at_most("spherical_89", clear_low, 2.0, "%", "the same, Sun at 89 degrees");
  section.figures.at_most(
      "spherical_haze", hazy, 2.0, "%",
      "with haze of depth 0.2: lines of sight, and the sky where the Sun stands at 87 degrees or higher");
  section.figures.report("spherical_haze_sky_89", hazy_sky, "%", "with haze: sky, Sun at 89 degrees");
  section.figures.at_most("spherical_haze_flux", hazy_flux, 2.0, "%",
                          "with haze: flux of the sky, Sun at 84, 87 and 89 degrees");
  section.figures.at_most("twilight", twilight, 5.0, "%",
                          "flux of the sky, Sun 2, 4 and 6 degrees below the horizon");
}

/// Of 6S for a sensor above the air that looks down, r in km (Vermote et al. 1997, subroutine ENVIRO).
double molecules_of_6s(double r) { return 1.0 - 0.930 * std::exp(-0.080 * r) - 0.070 * std::exp(-1.100 * r); }
double haze_of_6s(double r) { return 1.0 - 0.448 * std::exp(-0.27 * r) - 0.552 * std::exp(-2.83 * r); }

/// Layers that grow thicker upwards, of an exponential profile.
GroundSpread spread_of(double scale_km, double depth, const AerosolPhases* phases) {
  std::vector<double> altitude{0.0};
  LayerOptics optics;
  auto own = phases ? std::make_shared<AerosolPhases>() : nullptr;
  if (own) own->functions = phases->functions;
  for (int k = 0; k < 80; ++k) {
    const double low = altitude.back(), high = low + 0.1 * std::pow(1.05, k);
    const double share = depth * (std::exp(-low / scale_km) - std::exp(-high / scale_km));
    altitude.push_back(high);
    optics.rayleigh_scattering.push_back(phases ? 0.0 : share);
    optics.aerosol_scattering.push_back(phases ? share : 0.0);
    optics.aerosol_asymmetry.push_back(0.65);
    optics.gas_absorption.push_back(0.0);
    optics.aerosol_absorption.push_back(0.0);
    if (own)
      own->share.insert(own->share.end(), phases->shares(0), phases->shares(0) + phases->functions.size());
  }
  optics.aerosol_phases = own;
  return {altitude, optics, {}, 1 << 16};
}

/// F(r) of light scattered once (docs/theory/atmosphere_adjacency.md, equation 3).
double scattered_once(const PhaseFunction& phase, double scale_km, double r_km) {
  constexpr int kSteps = 2000;
  double inside = 0.0, all = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double u = (k + 0.5) / kSteps, theta = 0.5 * std::numbers::pi * u * u * u;
    const double share = u * u * phase.at(std::cos(theta)) * std::sin(theta);
    all += share;
    inside -= share * std::expm1(-r_km / (scale_km * std::tan(theta)));
  }
  return inside / all;
}

template <class Expected>
double largest(const GroundSpread& spread, const Expected& expected, double from_km, double to_km) {
  double worst = 0.0;
  for (double r = from_km; r <= to_km * 1.001; r *= 1.2)
    worst = std::max(worst, std::abs(spread.within(r) - expected(r)));
  return worst;
}

void add_environment(AtmosphereSection& section) {
  const AtmosphereColumn rural{AtmosphereDescription{}};
  const AerosolPhases phases = *rural.at(1e4 / 0.55).scattering.aerosol_phases;
  const GroundSpread thin = spread_of(2.0, 1e-4, &phases), haze = spread_of(2.0, 0.1, &phases);
  const auto once = [&](double r) { return scattered_once(phases.functions[0], 2.0, r); };
  section.figures.at_most("environment_molecules",
                          largest(spread_of(8.0, 0.1, nullptr), molecules_of_6s, 0.05, 10.0), 0.03, "",
                          "environment function F(r) of molecules against 6S, 0.05 to 10 km");
  section.figures.at_most("environment_haze", largest(haze, haze_of_6s, 2.0, 100.0), 0.03, "",
                          "of haze (rural, scale height 2 km) against 6S, 2 to 100 km");
  section.figures.report("environment_haze_near", largest(haze, haze_of_6s, 0.02, 2.0), "",
                         "the same, 0.02 to 2 km");
  section.figures.at_most("environment_haze_closed", largest(thin, once, 0.02, 100.0), 0.03, "",
                          "of thin haze against light scattered once in closed form, 0.02 to 100 km");
  double theirs = 0.0;
  for (double r = 0.02; r <= 2.0; r *= 1.2) theirs = std::max(theirs, std::abs(haze_of_6s(r) - once(r)));
  section.figures.report("environment_6s_closed", theirs, "", "6S against the same, 0.02 to 2 km");
}

}  // namespace

AtmosphereSection round_earth_section(const SectionOptions&) {
  AtmosphereSection section;
  section.title = "A round Earth, and the ground in the air";
  section.text =
      "Light about a round Earth against a spherical Monte Carlo program of our own that shares no formula with it: largest "
      "differences beyond 2.5 standard errors of the reference ([how](../theory/atmosphere_round_earth.md)). The environment function F(r) of "
      "6S (Vermote et al. 1997) is the share of the ground's light in the air that comes from within r: of haze below 2 km it is "
      "6S's fit that is off, as light scattered once in closed form says ([how](../theory/atmosphere_adjacency.md)).";
  add_spherical(section);
  add_environment(section);
  return section;
}

}  // namespace ifov::studies
