#pragma once

#include <cmath>
#include <numbers>

#include "atmosphere/layer_optics.h"
#include "atmosphere/scattering/column_solver.h"

namespace ifov::atmosphere::test {

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// Flat layers, as many sublayers as asked for.
inline ScatteringOptions flat(int nodes = 8, double sublayer_depth = 0.01, bool polarized = true) {
  ScatteringOptions options;
  options.nodes_per_hemisphere = nodes;
  options.sublayer_depth = sublayer_depth;
  options.most_sublayers = 400;
  options.spherical_earth = false;
  options.polarized = polarized;
  return options;
}

struct Column {
  Levels levels;
  LayerOptics optics;

  void add_layer(double top_km, double rayleigh, double aerosol, double asymmetry, double gas,
                 double aerosol_absorption = 0.0) {
    if (levels.altitude_km.empty()) levels = {{0.0}, {1013.0}, {288.0}};
    levels.altitude_km.push_back(top_km);
    levels.pressure_hPa.push_back(1013.0 * std::exp(-top_km / 8.0));
    levels.temperature_K.push_back(250.0);
    optics.rayleigh_scattering.push_back(rayleigh);
    optics.aerosol_scattering.push_back(aerosol);
    optics.aerosol_asymmetry.push_back(asymmetry);
    optics.gas_absorption.push_back(gas);
    optics.aerosol_absorption.push_back(aerosol_absorption);
  }
};

inline Column rayleigh_layer(double depth, double depolarization = 0.0) {
  Column column;
  column.add_layer(10.0, depth, 0.0, 0.0, 0.0);
  column.optics.depolarization = depolarization;
  return column;
}

/// Exponential profiles to 60 km: molecules (8 km), aerosol (1.5 km), and gas between gas_low_km and
/// gas_high_km with its own scale height.
struct Air {
  double rayleigh = 0.1, aerosol = 0.2, asymmetry = 0.65, aerosol_absorption = 0.02;
  double gas = 0.0, gas_scale_km = 2.0, gas_low_km = 0.0, gas_high_km = 60.0;
  Column column() const {
    Column result;
    const auto share = [](double low, double high, double from, double to, double scale) {
      const double a = std::max(low, from), b = std::min(high, to);
      if (b <= a) return 0.0;
      return (std::exp(-a / scale) - std::exp(-b / scale)) /
             (std::exp(-from / scale) - std::exp(-to / scale));
    };
    double low = 0.0;
    for (int i = 0; i < 34; ++i) {
      const double high = low + (low < 25.0 ? 1.0 : 35.0 / 9.0);
      const double haze = share(low, high, 0.0, 60.0, 1.5);
      result.add_layer(high, rayleigh * share(low, high, 0.0, 60.0, 8.0), aerosol * haze, asymmetry,
                       gas * share(low, high, gas_low_km, gas_high_km, gas_scale_km),
                       aerosol_absorption * haze);
      low = high;
    }
    result.optics.depolarization = 0.0279;
    return result;
  }
};

/// Optical depth of all air for Rayleigh scattering at sea level (Bodhaine et al. 1999, eq. 30).
inline double rayleigh_depth(double wavelength_um) {
  const double s = 1.0 / (wavelength_um * wavelength_um);
  return 0.0021520 * (1.0455996 - 341.29061 * s - 0.90230850 / s) / (1.0 + 0.0027059889 * s - 85.968563 / s);
}

/// Radiance upward at the top or downward at the ground with Lambertian ground, by the coupling terms.
inline StokesVector light_with_ground(const ColumnSolution& solution, const Propagation& direction,
                                      double albedo) {
  const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(0.0);
  const double irradiance =
      (fluxes.direct_down + fluxes.diffuse_down) / (1.0 - albedo * solution.spherical_albedo());
  const double leaving = albedo * irradiance / std::numbers::pi;
  const double observer = direction.mu > 0.0 ? 1e4 : 0.0;
  const PathLight path = solution.sunlit().path(direction, observer);
  StokesVector light = path.radiance();
  if (direction.mu > 0.0) {
    light += leaving * solution.diffuse_transmittance(direction.mu, observer);
    light.i += leaving * path.transmittance;
  } else {
    light += leaving * solution.groundlit().path(direction, observer).multiple;
  }
  return light;
}

}  // namespace ifov::atmosphere::test
