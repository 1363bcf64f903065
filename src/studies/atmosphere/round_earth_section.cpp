#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "atmosphere/scattering/column_solver.h"
#include "math/angle.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/environment_figures.h"
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
  section.figures.at_most("spherical_haze_sky_89", hazy_sky, 2.0, "%", "with haze: sky, Sun at 89 degrees");
  section.figures.at_most("spherical_haze_flux", hazy_flux, 2.0, "%",
                          "with haze: flux of the sky, Sun at 84, 87 and 89 degrees");
  section.figures.at_most("twilight", twilight, 5.0, "%",
                          "flux of the sky, Sun 2, 4 and 6 degrees below the horizon");
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
  add_environment_figures(section.figures);
  return section;
}

}  // namespace ifov::studies
