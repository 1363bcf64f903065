#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "atmosphere/scattering/column_solver.h"
#include "math/angle.h"
#include "studies/atmosphere/atmosphere_results.h"

namespace ifov::studies {
namespace {

using namespace atmosphere;
ColumnSolver flat_solver(int nodes, double sublayer_depth, bool polarized) {
  ScatteringOptions options;
  options.nodes_per_hemisphere = nodes;
  options.sublayer_depth = sublayer_depth;
  options.most_sublayers = 400;
  options.spherical_earth = false;
  options.polarized = polarized;
  return ColumnSolver(options);
}

ColumnSolution solve_layer(const ColumnSolver& solver, double depth, double mu0) {
  const Levels levels{{0.0, 10.0}, {1013.0, 265.0}, {288.0, 223.0}};
  LayerOptics optics{{0.0}, {depth}, {0.0}, {0.0}, {0.0}};
  optics.depolarization = 0.0;
  return solver.solve(levels, optics, std::acos(mu0));
}

StokesVector light_with_ground(const ColumnSolution& solution, const Propagation& direction, double albedo) {
  const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(0.0);
  const double leaving = albedo * (fluxes.direct_down + fluxes.diffuse_down) /
                         (1.0 - albedo * solution.spherical_albedo()) / std::numbers::pi;
  const PathLight path = solution.sunlit().path(direction, 1e4);
  StokesVector light = path.radiance();
  light += leaving * solution.diffuse_transmittance(direction.mu, 1e4);
  light.i += leaving * path.transmittance;
  return std::numbers::pi * light;
}

void add_natraj(const SectionOptions& options, AtmosphereSection& section) {
  const std::string name = "atmosphere/rayleigh_polarized/coulson_natraj_tau0.5_mu0_0.2.csv";
  const auto file = options.reference.file(name);
  if (!file) return section.not_measured("natraj", "12 directions of Natraj et al. (2009)", name);
  double worst = 0.0, worst_scalar = 0.0;
  const ColumnSolution vector = solve_layer(flat_solver(16, 0.0025, true), 0.5, 0.2);
  const ColumnSolution scalar = solve_layer(flat_solver(16, 0.0025, false), 0.5, 0.2);
  for (const auto& row : number_rows(*file, 6)) {
    const Propagation direction{row[1], row[2] * math::kDegree};
    const StokesVector light = light_with_ground(vector, direction, row[0]);
    worst =
        std::max({worst, std::abs(light.i - row[3]), std::abs(light.q + row[4]), std::abs(light.u - row[5])});
    worst_scalar =
        std::max(worst_scalar, std::abs(light_with_ground(scalar, direction, row[0]).i / row[3] - 1.0));
  }
  section.figures.at_most(
      "natraj", worst, 1e-4, "",
      "Natraj et al. (2009), 12 directions: largest difference of I, Q, U, for a flux of pi");
  section.figures.report("natraj_scalar", 100.0 * worst_scalar, "%",
                         "error of I where polarization is left out");
}

void add_table(const SectionOptions& options, AtmosphereSection& section) {
  const std::string name = "atmosphere/derived/rayleigh_vector_sos.csv";
  const auto file = options.reference.file(name);
  if (!file) return section.not_measured("directions_480", "480 directions", name);
  double worst = 0.0, depth = 0.0, mu0 = 0.0;
  std::vector<ColumnSolution> solutions;
  PlotSeries vector{"I, Q, U", "#0072b2", {}, {}, true}, scalar{"I alone", "#d55e00", {}, {}, true};
  for (const auto& row : number_rows(*file, 9)) {
    if (row[0] != depth || row[1] != mu0) {
      depth = row[0];
      mu0 = row[1];
      solutions.clear();
      for (const bool polarized : {true, false})
        solutions.push_back(solve_layer(flat_solver(12, 0.005, polarized), depth, mu0));
    }
    const Propagation direction{row[3], row[4] * math::kDegree};
    const StokesVector light = light_with_ground(solutions[0], direction, row[2]);
    worst =
        std::max({worst, std::abs(light.i - row[5]), std::abs(light.q - row[6]), std::abs(light.u - row[7])});
    if (row[2] != 0.0) continue;
    const double cosine = -mu0 * row[3] + std::sqrt((1.0 - mu0 * mu0) * (1.0 - row[3] * row[3])) *
                                              std::cos(direction.azimuth_rad);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / math::kDegree;
    vector.x.push_back(angle), vector.y.push_back(100.0 * (light.i / row[5] - 1.0));
    scalar.x.push_back(angle);
    scalar.y.push_back(100.0 * (light_with_ground(solutions[1], direction, row[2]).i / row[5] - 1.0));
  }
  section.figures.at_most("directions_480", worst, 2e-4, "",
                          "480 directions by a finer solution: largest difference");
  Plot plot;
  plot.title = "Radiance above molecules over black ground";
  plot.x_label = "scattering angle, degrees";
  plot.y_label = "error of I, %";
  plot.y_low = -12.0;
  plot.y_high = 14.0;
  plot.series = {scalar, vector};
  section.plots.push_back(
      {"polarization", plot,
       "What is wrong where light is taken for unpolarized. Depths 0.1 to 1 and three heights of the "
       "Sun; molecules without depolarization."});
}

}  // namespace

AtmosphereSection scattering_section(const SectionOptions& options) {
  AtmosphereSection section;
  section.title = "Scattering";
  section.text = "Vector successive orders against tables and against the conservation of light.";
  add_natraj(options, section);
  add_table(options, section);
  double worst = 0.0;
  for (const double depth : {0.05, 0.5, 1.5})
    for (const double mu0 : {0.2, 0.7}) {
      const ColumnSolution solution = solve_layer(flat_solver(8, 0.01, true), depth, mu0);
      const FluxProfile& fluxes = solution.sunlit().fluxes();
      const double lit =
          (fluxes.direct_down.back() + fluxes.diffuse_down.back()) / (1.0 - solution.spherical_albedo());
      double straight = 0.0;  // of a ground of radiance 1
      const GaussNodes nodes = gauss_nodes(24);
      for (std::size_t j = 0; j < nodes.position.size(); ++j)
        straight += 2.0 * std::numbers::pi * nodes.weight[j] * nodes.position[j] *
                    std::exp(-depth / nodes.position[j]);
      const double escapes =
          fluxes.up.front() + lit / std::numbers::pi * (straight + solution.groundlit().fluxes().up.front());
      worst = std::max(worst, std::abs(escapes / mu0 - 1.0));
    }
  section.figures.at_most("white_ground", worst, 1e-3, "",
                          "lossless molecules over white ground, depths 0.05 to 1.5: albedo less 1, at most");
  return section;
}

}  // namespace ifov::studies
