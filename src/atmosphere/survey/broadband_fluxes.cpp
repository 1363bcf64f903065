#include "atmosphere/survey/broadband_fluxes.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/thermal/emitted_light.h"
#include "atmosphere/thermal/thermal_column.h"
#include "atmosphere/thermal/thermal_scattering.h"
#include "core/parallel.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

constexpr double kStefanBoltzmann = 5.670374419e-8;
/// The band model begins here; below, the air is taken for opaque.
constexpr double kFirst_cm1 = 200.0, kLastThermal_cm1 = 3250.0;

/// Irradiance by wavelength as irradiance by wavenumber.
double by_wavenumber(double wavenumber_cm1) { return 1e4 / (wavenumber_cm1 * wavenumber_cm1); }

/// Per um, of one wavenumber.
double emitted_down(const AtmosphereColumn& column, double wavenumber_cm1, const GaussNodes& nodes) {
  const ColumnOptics optics = column.at(wavenumber_cm1);
  const Levels& levels = column.levels();
  std::vector<double> planck;
  for (const double t : levels.temperature_K)
    planck.push_back(radiometry::planck_w_m2_sr_um(optics.wavelength_um, t));
  const bool cloudy = !column.description().aerosol.clouds.empty();
  double sum = 0.0;
  for (std::size_t term = 0; term < optics.terms(); ++term) {
    const LayerOptics layers = optics.term(term);
    if (cloudy && scatters_own_light(layers)) {
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

}  // namespace

double longwave_down_w_m2(const AtmosphereColumn& column, double step_cm1, int threads) {
  const GaussNodes nodes = gauss_nodes(4);
  const double ground_k = column.levels().temperature_K.front();
  double below = kStefanBoltzmann * std::pow(ground_k, 4);
  for (double nu = kFirst_cm1; nu < 30000.0; nu += 5.0)
    below -= 5.0 * std::numbers::pi * radiometry::planck_w_m2_sr_um(1e4 / nu, ground_k) * by_wavenumber(nu);
  const double first = kFirst_cm1 + 0.5 * (step_cm1 - 5.0);
  const auto count = static_cast<std::size_t>(std::ceil((kLastThermal_cm1 - first) / step_cm1));
  std::vector<double> parts(count);
  parallel_for(static_cast<std::int64_t>(count), threads, [&](std::int64_t i) {
    const double nu = first + static_cast<double>(i) * step_cm1;
    parts[static_cast<std::size_t>(i)] = step_cm1 * by_wavenumber(nu) * emitted_down(column, nu, nodes);
  });
  return below + std::accumulate(parts.begin(), parts.end(), 0.0);  // in one order, whatever the threads
}

}  // namespace ifov::atmosphere
