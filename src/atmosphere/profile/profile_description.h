#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ifov::atmosphere {

/// A level of the user's own profile (a radiosonde). Of the two measures of humidity at most one is given;
/// without either the model atmosphere's mixing ratio holds.
struct UserLevel {
  double altitude_km = 0.0;  ///< above mean sea level
  double pressure_hPa = 0.0;
  double temperature_K = 0.0;
  std::optional<double> relative_humidity_percent;  ///< over liquid water
  std::optional<double> mixing_ratio_g_kg;          ///< water vapour to dry air, by mass
  std::optional<double> ozone_ppmv;                 ///< by volume; default: the model atmosphere's
};

/// What is asked of the air. The model atmosphere gives everything that is not said here.
struct ProfileDescription {
  std::string model = "mid-latitude summer";
  std::vector<UserLevel> levels;             ///< two or more at rising altitudes, or none
  std::optional<double> ground_altitude_km;  ///< default: the first of `levels`, else 0; below 6 km
  std::optional<double> water_vapour_g_cm2;  ///< precipitable water above the ground
  std::optional<double> ozone_DU;            ///< column above the ground; 1 DU = 0.001 atm-cm
  /// Mixing ratios at the ground, the whole profile scaled alike; nothing: as tabulated in 1986.
  std::optional<double> co2_ppm = 420.0;
  std::optional<double> ch4_ppm = 1.9;
  std::optional<double> n2o_ppm = 0.335;
  /// Of any gas, in place of what is said of it above; null: nothing.
  std::shared_ptr<const struct GasRequests> gases = {};
  bool limit_humidity = true;  ///< relative humidity stays at or below 100 %
};

}  // namespace ifov::atmosphere
