#include "atmosphere/survey/broadband_fluxes.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/thermal/emitted_light.h"
#include "atmosphere/thermal/thermal_column.h"
#include "atmosphere/thermal/thermal_scattering.h"
#include "core/parallel.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::atmosphere {
namespace {

constexpr double kStefanBoltzmann = 5.670374419e-8;
/// The band model begins here; below, the air is taken for opaque.
constexpr double kFirst_cm1 = 200.0, kLastThermal_cm1 = 3250.0;
constexpr double kFirstSolar_cm1 = 1000.0, kLastSolar_cm1 = 49000.0;

/// Irradiance by wavelength as irradiance by wavenumber.
double by_wavenumber(double wavenumber_cm1) { return 1e4 / (wavenumber_cm1 * wavenumber_cm1); }

/// Per um, of one wavenumber.
double emitted_down(const AtmosphereColumn& column, double wavenumber_cm1, const GaussNodes& nodes) {
  const ColumnOptics optics = column.at(wavenumber_cm1);
  const Levels& levels = column.levels();
  std::vector<double> planck;
  for (const double t : levels.temperature_K)
    planck.push_back(radiometry::planck_w_m2_sr_um(optics.wavelength_um, t));
  double sum = 0.0;
  for (std::size_t term = 0; term < optics.terms(); ++term) {
    const LayerOptics layers = optics.term(term);
    if (scatters_own_light(layers)) {
      sum +=
          optics.weight(term) * EmittedLight(levels, layers, planck).irradiance(levels.altitude_km.front());
      continue;
    }
    std::vector<double> absorption = layers.gas_absorption;
    for (std::size_t i = 0; i < absorption.size(); ++i) absorption[i] += layers.aerosol_absorption[i];
    const ThermalColumn thermal(levels.altitude_km, planck, absorption);
    sum += optics.weight(term) * thermal.radiances(nodes, {1.0, planck[0]}).flux_down[0];
  }
  return sum;
}

/// Sum of f(wavenumber) in the order of wavenumbers, whatever the threads.
template <class Sum, class F>
Sum sum_of(std::size_t count, int threads, const F& f) {
  std::vector<Sum> parts(count);
  parallel_for(static_cast<std::int64_t>(count), threads,
               [&](std::int64_t i) { parts[static_cast<std::size_t>(i)] = f(static_cast<std::size_t>(i)); });
  Sum sum{};
  for (const Sum& part : parts) sum += part;
  return sum;
}

struct DirectAndDiffuse {
  double direct = 0.0, diffuse = 0.0, above = 0.0;
  DirectAndDiffuse& operator+=(const DirectAndDiffuse& other) {
    direct += other.direct, diffuse += other.diffuse, above += other.above;
    return *this;
  }
};

}  // namespace

double longwave_down_w_m2(const AtmosphereColumn& column, double step_cm1, int threads) {
  const GaussNodes nodes = gauss_nodes(4);
  const double ground_k = column.levels().temperature_K.front();
  double below = kStefanBoltzmann * std::pow(ground_k, 4);
  for (double nu = kFirst_cm1; nu < 30000.0; nu += 5.0)
    below -= 5.0 * std::numbers::pi * radiometry::planck_w_m2_sr_um(1e4 / nu, ground_k) * by_wavenumber(nu);
  const double first = kFirst_cm1 + 0.5 * (step_cm1 - 5.0);
  const auto count = static_cast<std::size_t>(std::ceil((kLastThermal_cm1 - first) / step_cm1));
  return below + sum_of<double>(count, threads, [&](std::size_t i) {
           const double nu = first + static_cast<double>(i) * step_cm1;
           return step_cm1 * by_wavenumber(nu) * emitted_down(column, nu, nodes);
         });
}

BroadbandSunlight sunlight_down(const AtmosphereColumn& column, double sun_zenith_rad, double step_cm1,
                                int threads) {
  ScatteringOptions options;
  options.nodes_per_hemisphere = 4;
  options.polarized = false;
  options.sublayer_depth = 0.05;
  const ColumnSolver solver(options);
  const radiometry::Spectrum& spectrum = radiometry::solar_irradiance_1au();
  const double ground_km = column.levels().altitude_km.front();
  const auto count = static_cast<std::size_t>(std::ceil((kLastSolar_cm1 - kFirstSolar_cm1) / step_cm1));
  const DirectAndDiffuse sum = sum_of<DirectAndDiffuse>(count, threads, [&](std::size_t i) {
    const double nu = kFirstSolar_cm1 + static_cast<double>(i) * step_cm1;
    DirectAndDiffuse part;
    for (double at = nu - 0.5 * step_cm1 + 2.5; at < nu + 0.5 * step_cm1; at += 5.0)
      part.above += spectrum.at(1e4 / at) * 5.0 * by_wavenumber(at);
    const ColumnOptics optics = column.at(nu);
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const ColumnSolution solution = solver.solve(column.levels(), optics.term(term), sun_zenith_rad);
      const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(ground_km);
      part.direct += part.above * optics.weight(term) * fluxes.direct_down;
      part.diffuse += part.above * optics.weight(term) * fluxes.diffuse_down;
    }
    return part;
  });
  return {sum.direct / std::cos(sun_zenith_rad), sum.diffuse, sum.above};
}

}  // namespace ifov::atmosphere
