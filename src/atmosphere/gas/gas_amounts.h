#pragma once

#include <vector>

#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

/// What a path or a layer holds of all absorbers, scaled to the standard state as the band model and the
/// continua want it (LOWTRAN7, Kneizys et al. 1988). Amounts of successive pieces of a path add.
struct GasAmounts {
  /// W of every band of the band model: amount times (P/P0)^n (T0/T)^m; g cm-2 for water vapour, else atm-cm.
  std::vector<double> band;
  double water_self = 0.0;                    ///< vapour by itself, molecules cm-2
  double water_self_cold = 0.0;               ///< the same times (296 K - T)/36 K, within 0 and 1
  double water_foreign = 0.0;                 ///< vapour by air, molecules cm-2
  double nitrogen = 0.0;                      ///< km
  double oxygen = 0.0;                        ///< atm-cm times P/P0
  double oxygen_temperature = 0.0;            ///< the same times T - 220 K
  double oxygen_temperature_2 = 0.0;          ///< the same times (T - 220 K)^2
  double oxygen_pairs = 0.0;                  ///< km times the square of oxygen's density in amagat
  double ozone = 0.0;                         ///< atm-cm
  double ozone_temperature = 0.0;             ///< the same times T - 273.15 K
  double ozone_temperature_2 = 0.0;           ///< the same times (T - 273.15 K)^2
  double nitrogen_dioxide = 0.0;              ///< atm-cm
  double nitrogen_dioxide_temperature = 0.0;  ///< the same times T - 220 K

  /// Adds `factor` times another's.
  void add(const GasAmounts& other, double factor);
};

/// Straight up from `first_km` to `last_km`.
GasAmounts vertical_amounts(const Profile& profile, double first_km, double last_km);
/// Of each layer between successive altitudes.
std::vector<GasAmounts> layer_amounts(const Profile& profile, const std::vector<double>& altitude_km);
/// Along `length_km` at one altitude.
GasAmounts horizontal_amounts(const Profile& profile, double altitude, double length_km);
/// From `first_km` up to `last_km` under a zenith angle (at `first_km`, below 90 degrees), straight through
/// spherical shells.
GasAmounts slant_amounts(const Profile& profile, double first_km, double last_km, double zenith_deg);
/// How much longer than the shell's height a straight path through it is, from `first_km` to `last_km`, that
/// has this zenith angle at `start_km`.
double slant_factor(double start_km, double zenith_deg, double first_km, double last_km);

}  // namespace ifov::atmosphere
