#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace ifov::atmosphere {

struct AerosolPhases;

/// Boundaries of the layers, from the ground up: n + 1 levels bound n layers.
struct Levels {
  std::vector<double> altitude_km;  ///< above mean sea level, rising
  std::vector<double> pressure_hPa;
  std::vector<double> temperature_K;
  std::size_t layers() const { return altitude_km.empty() ? 0 : altitude_km.size() - 1; }
};

/// Vertical optical depths of the layers, from the ground up, at one wavenumber and for one absorption term.
/// Extinction of a layer is the sum of the four depths.
struct LayerOptics {
  std::vector<double> gas_absorption;
  std::vector<double> rayleigh_scattering;
  std::vector<double> aerosol_scattering;
  std::vector<double> aerosol_absorption;
  std::vector<double> aerosol_asymmetry;  ///< mean cosine of the aerosol's scattering angle
  /// How the aerosol of each layer scatters; null: by Henyey-Greenstein functions of the asymmetries.
  std::shared_ptr<const AerosolPhases> aerosol_phases = {};
  /// What of the aerosol's depths clouds have; empty: there are none.
  std::vector<double> cloud_scattering = {}, cloud_absorption = {};
  double depolarization = 0.0279;  ///< of Rayleigh scattering at this wavelength
  std::size_t layers() const { return gas_absorption.size(); }
};

}  // namespace ifov::atmosphere
