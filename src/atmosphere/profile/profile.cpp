#include "atmosphere/profile/profile.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/profile/column_integral.h"

namespace ifov::atmosphere {
namespace {

constexpr double kBoltzmann = 1.380649e-23;

std::size_t interval_of(const std::vector<double>& altitude, double at) {
  const auto above = std::upper_bound(altitude.begin() + 1, altitude.end() - 1, at);
  return static_cast<std::size_t>(above - altitude.begin()) - 1;
}

double fraction(const std::vector<double>& altitude, std::size_t i, double at) {
  return (at - altitude[i]) / (altitude[i + 1] - altitude[i]);
}

}  // namespace

double saturated_vapour_g_m3(double temperature_K) {
  const double a = 273.15 / temperature_K;
  return a * std::exp(18.9766 - (14.9595 + 2.43882 * a) * a);
}

double Profile::air_per_cm3(std::size_t level) const {
  return 100.0 * pressure_hPa[level] / (kBoltzmann * temperature_K[level]) * 1e-6;
}

double Profile::water_vapour_g_m3(std::size_t level) const {
  return of(Gas::h2o)[level] * air_per_cm3(level) * kVapourGramPerPpmvMolecule;
}

double Profile::relative_humidity_percent(std::size_t level) const {
  return 100.0 * water_vapour_g_m3(level) / saturated_vapour_g_m3(temperature_K[level]);
}

double Profile::column_atm_cm(Gas gas) const {
  std::vector<double> density(levels());
  for (std::size_t i = 0; i < levels(); ++i) density[i] = of(gas)[i] * 1e-6 * air_per_cm3(i) / kLoschmidtCm3;
  return 1e5 * column_integral(altitude_km, density, altitude_km.front(), altitude_km.back());
}

double Profile::precipitable_water_g_cm2() const {
  std::vector<double> density(levels());
  for (std::size_t i = 0; i < levels(); ++i) density[i] = 0.1 * water_vapour_g_m3(i);
  return column_integral(altitude_km, density, altitude_km.front(), altitude_km.back());
}

double Profile::pressure_at(double altitude) const {
  const std::size_t i = interval_of(altitude_km, altitude);
  return pressure_hPa[i] *
         std::pow(pressure_hPa[i + 1] / pressure_hPa[i], fraction(altitude_km, i, altitude));
}

double Profile::temperature_at(double altitude) const {
  const std::size_t i = interval_of(altitude_km, altitude);
  return temperature_K[i] + (temperature_K[i + 1] - temperature_K[i]) * fraction(altitude_km, i, altitude);
}

Profile Profile::between(double ground, double top) const {
  Profile part;
  part.nitrogen = nitrogen;
  const auto add = [&](double altitude) {
    const std::size_t i = interval_of(altitude_km, altitude);
    const double f = fraction(altitude_km, i, altitude);
    part.altitude_km.push_back(altitude);
    part.pressure_hPa.push_back(pressure_at(altitude));
    part.temperature_K.push_back(temperature_at(altitude));
    for (std::size_t g = 0; g < kGasCount; ++g) {
      const std::vector<double>& x = mixing_ratio_ppmv[g];
      part.mixing_ratio_ppmv[g].push_back(x[i] + (x[i + 1] - x[i]) * f);
    }
  };
  add(ground);
  for (const double altitude : altitude_km)
    if (altitude > ground + 1e-6 && altitude < top - 1e-6) add(altitude);
  add(top);
  return part;
}

}  // namespace ifov::atmosphere
