#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/thermal/thermal_column.h"
#include "radiometry/planck.h"

// What one column costs: light scattered in all orders, once only, a sky dome of a solved column, thermal
// light. The answers are checked: energy, and a sky as bright as its air.

namespace {

using namespace ifov::atmosphere;

constexpr double kSunZenith_rad = 0.8;

AtmosphereDescription described(bool haze) {
  AtmosphereDescription description;
  if (!haze) description.aerosol.type = "none";
  return description;
}

const AtmosphereColumn& hazy() {
  static const AtmosphereColumn column(described(true));
  return column;
}
const AtmosphereColumn& clear() {
  static const AtmosphereColumn column(described(false));
  return column;
}

void solve(benchmark::State& state, const AtmosphereColumn& column, bool polarized) {
  ScatteringOptions options;
  options.polarized = polarized;
  const ColumnSolver solver(options);
  const LayerOptics optics = column.at(20000.0).term(0);
  for (auto _ : state) {
    const ColumnSolution solution = solver.solve(column.levels(), optics, kSunZenith_rad);
    const FluxProfile::Fluxes ground = solution.sunlit().fluxes().at(0.0);
    const double all = ground.direct_down + ground.diffuse_down + solution.sunlit().fluxes().up.front();
    if (!(all > 0.8 * std::cos(kSunZenith_rad) && all <= std::cos(kSunZenith_rad))) {
      state.SkipWithError("light is lost or made");
    }
    benchmark::DoNotOptimize(solution);
  }
  state.counters["at_most"] = 20.0;  // ms
}

void solve_haze_polarized(benchmark::State& state) { solve(state, hazy(), true); }
void solve_haze_scalar(benchmark::State& state) { solve(state, hazy(), false); }
void solve_clear_polarized(benchmark::State& state) { solve(state, clear(), true); }

void solve_once(benchmark::State& state) {
  const ColumnSolver solver;
  const LayerOptics optics = hazy().at(20000.0).term(0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(solver.solve_first_order(hazy().levels(), optics, kSunZenith_rad));
  }
}

/// 12 zenith angles x 19 azimuths.
void sky_dome(benchmark::State& state) {
  const ColumnSolution solution =
      ColumnSolver().solve(hazy().levels(), hazy().at(20000.0).term(0), kSunZenith_rad);
  for (auto _ : state) {
    double sum = 0.0;
    for (int ring = 0; ring < 12; ++ring) {
      const SlantSource source = solution.sunlit().along(-(ring + 0.5) / 12.0);
      for (int k = 0; k < 19; ++k) sum += source.sky(std::numbers::pi * k / 18.0, 0.0).radiance().i;
    }
    if (!(sum > 0.0)) state.SkipWithError("a dark sky");
    benchmark::DoNotOptimize(sum);
  }
}

void thermal_term(benchmark::State& state) {
  const AtmosphereColumn& column = clear();
  const ColumnOptics optics = column.at(667.0 - std::fmod(667.0, 5.0));
  const LayerOptics layers = optics.term(optics.terms() - 1);
  std::vector<double> planck;
  for (double t : column.levels().temperature_K) {
    planck.push_back(ifov::radiometry::planck_w_m2_sr_um(optics.wavelength_um, t));
  }
  const ThermalColumn thermal(column.levels().altitude_km, planck, layers.gas_absorption);
  const GaussNodes nodes = gauss_nodes(8);
  for (auto _ : state) {
    const ThermalRadiance light = thermal.radiances(nodes, {0.95, planck[0]});
    if (std::abs(light.flux_down[0] / (std::numbers::pi * planck[0]) - 1.0) > 0.01) {
      state.SkipWithError("carbon dioxide is not opaque at 15 um");
    }
    benchmark::DoNotOptimize(light);
  }
}

BENCHMARK(solve_haze_polarized)->Unit(benchmark::kMillisecond);
BENCHMARK(solve_haze_scalar)->Unit(benchmark::kMillisecond);
BENCHMARK(solve_clear_polarized)->Unit(benchmark::kMillisecond);
BENCHMARK(solve_once)->Unit(benchmark::kMillisecond);
BENCHMARK(sky_dome)->Unit(benchmark::kMillisecond);
BENCHMARK(thermal_term)->Unit(benchmark::kMicrosecond);

}  // namespace
