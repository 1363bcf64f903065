#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::atmosphere {

/// The gases whose lines the band model knows, in the order of data/atmosphere/profiles.txt.
enum class Gas { h2o, co2, o3, n2o, co, ch4, o2, nh3, no, no2, so2 };
inline constexpr std::size_t kGasCount = 11;
inline constexpr std::array<std::string_view, kGasCount> kGasNames{"H2O", "CO2", "O3", "N2O", "CO", "CH4",
                                                                   "O2",  "NH3", "NO", "NO2", "SO2"};

/// Molecules in a cm3 of gas at 273.15 K and 1013.25 hPa (the value LOWTRAN7's amounts are scaled with).
inline constexpr double kLoschmidtCm3 = 2.6868e19;
inline constexpr double kTopOfAtmosphereKm = 100.0;

/// The state of the air over height: values at rising altitudes (above mean sea level, first the ground).
/// Between them pressure and densities are exponential, temperature is linear.
struct Profile {
  std::vector<double> altitude_km;
  std::vector<double> pressure_hPa;
  std::vector<double> temperature_K;
  std::array<std::vector<double>, kGasCount> mixing_ratio_ppmv;  ///< by volume, of the moist air

  double nitrogen = 0.781;  ///< by volume, of dry air

  std::size_t levels() const { return altitude_km.size(); }
  double ground_km() const { return altitude_km.front(); }
  const std::vector<double>& of(Gas gas) const { return mixing_ratio_ppmv[static_cast<std::size_t>(gas)]; }
  std::vector<double>& of(Gas gas) { return mixing_ratio_ppmv[static_cast<std::size_t>(gas)]; }

  double air_per_cm3(std::size_t level) const;  ///< molecules, p/(k T)
  double water_vapour_g_m3(std::size_t level) const;
  double relative_humidity_percent(std::size_t level) const;  ///< over liquid water
  /// Column of a gas from the ground up, atm-cm (the height of the pure gas at 273.15 K and 1013.25 hPa).
  double column_atm_cm(Gas gas) const;
  /// Column of water vapour, g cm-2 (precipitable water in cm).
  double precipitable_water_g_cm2() const;

  double pressure_at(double altitude) const;     ///< log-linear, hPa
  double temperature_at(double altitude) const;  ///< linear, K
  /// The same profile from `ground` up to `top`, both interpolated; mixing ratios linear in altitude.
  Profile between(double ground, double top) const;
};

/// Density of saturated water vapour over liquid water, g m-3:
/// A exp(18.9766 - 14.9595 A - 2.43882 A^2), A = 273.15 / T (LOWTRAN7).
double saturated_vapour_g_m3(double temperature_K);

/// g m-3 of water vapour in 1 ppmv at an air density of 1 cm-3.
inline constexpr double kVapourGramPerPpmvMolecule = 18.015 / 6.022045e23;

/// One of the six model atmospheres (Anderson et al. 1986) to 120 km, as tabulated: "tropical", "mid-latitude
/// summer", "mid-latitude winter", "subarctic summer", "subarctic winter", "US standard 1976". InputError
/// with the choices for any other name.
const Profile& model_atmosphere(std::string_view name);
const std::vector<std::string>& model_atmosphere_names();

}  // namespace ifov::atmosphere
