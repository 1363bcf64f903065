#pragma once

#include <optional>
#include <vector>

#include "atmosphere/thermal/thermal_scattering.h"

namespace ifov::atmosphere {

class ThermalColumn;

/// Thermal light of a column at one wavelength and for one absorption term, with what is scattered of it, over black and cold
/// ground: what ChannelEmission interpolates, solved in full.
class EmittedLight {
 public:
  /// `planck` at the levels. `options` as ThermalScattering's.
  EmittedLight(const Levels& levels, const LayerOptics& optics, std::vector<double> planck,
               const ScatteringOptions& options = {});

  /// As ThermalColumn's, in the unit of `planck`.
  double sky(double mu, double observer_km) const;
  double line_of_sight(double observer_km, double mu, double surface_km) const;
  /// On level ground, of sky(): 8 Gauss nodes, within 3e-4.
  double irradiance(double observer_km) const;

 private:
  ThermalColumn column() const;
  std::vector<double> scattered(double mu) const;
  std::vector<double> altitude_km_, planck_, absorption_;  ///< of sublayers, where light is scattered
  std::optional<ThermalScattering> solved_;
};

}  // namespace ifov::atmosphere
