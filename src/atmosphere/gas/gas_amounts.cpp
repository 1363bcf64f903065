#include "atmosphere/gas/gas_amounts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/gas/band_model.h"
#include "atmosphere/profile/column_integral.h"

namespace ifov::atmosphere {
namespace {

constexpr double kStandardPressure = 1013.25, kStandardTemperature = 273.15;
constexpr double kLoschmidtPerKm = kLoschmidtCm3 * 1e5;
constexpr double kVapourPerKm = 3.3429e21;  ///< molecules cm-2 km-1 in 1 g m-3
constexpr double kEarthRadiusKm = 6371.23;

/// Densities at the profile's levels, each amount per km.
struct Densities {
  std::vector<std::vector<double>> band;
  std::vector<double> water_self, water_foreign, nitrogen, oxygen, oxygen_pairs, ozone, nitrogen_dioxide;
};

Densities densities_of(const Profile& profile) {
  Densities d;
  const std::size_t levels = profile.levels();
  const std::vector<Band>& bands = BandModel::instance().bands();
  d.band.assign(bands.size(), std::vector<double>(levels));
  constexpr double kContinuumDensity = kStandardTemperature / 296.0;
  for (std::size_t i = 0; i < levels; ++i) {
    const double p = profile.pressure_hPa[i] / kStandardPressure;
    const double t = kStandardTemperature / profile.temperature_K[i];
    const double per_ppmv = 1e-6 * profile.air_per_cm3(i) / kLoschmidtCm3 * 1e5;
    const double vapour = profile.water_vapour_g_m3(i);
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const double amount = bands[b].gas == Gas::h2o ? 0.1 * vapour : per_ppmv * profile.of(bands[b].gas)[i];
      d.band[b][i] = amount * std::pow(p, bands[b].n) * std::pow(t, bands[b].m);
    }
    const double water = kVapourPerKm * vapour / kLoschmidtPerKm;
    d.water_self.push_back(kLoschmidtPerKm * water * water / kContinuumDensity);
    d.water_foreign.push_back(kLoschmidtPerKm * water * std::max(p * t - water, 0.0) / kContinuumDensity);
    d.nitrogen.push_back(profile.nitrogen * p * p * t * std::sqrt(t));
    d.oxygen.push_back(per_ppmv * profile.of(Gas::o2)[i] * p);
    const double oxygen_amagat = 1e-5 * per_ppmv * profile.of(Gas::o2)[i];
    d.oxygen_pairs.push_back(oxygen_amagat * oxygen_amagat);
    d.ozone.push_back(per_ppmv * profile.of(Gas::o3)[i]);
    d.nitrogen_dioxide.push_back(per_ppmv * profile.of(Gas::no2)[i]);
  }
  return d;
}

double coldness(double t) { return std::clamp((296.0 - t) / 36.0, 0.0, 1.0); }
double above_220(double t) { return t - 220.0; }
double above_220_squared(double t) { return above_220(t) * above_220(t); }
double celsius(double t) { return t - 273.15; }
double celsius_squared(double t) { return celsius(t) * celsius(t); }

GasAmounts integrated(const Profile& profile, const Densities& d, double first, double last) {
  const std::vector<double>& z = profile.altitude_km;
  const auto plain = [&](const std::vector<double>& density) {
    return column_integral(z, density, first, last);
  };
  const auto weighted = [&](const std::vector<double>& density, double (*factor)(double)) {
    return column_integral(z, density, profile.temperature_K, factor, first, last);
  };
  GasAmounts amounts;
  for (const std::vector<double>& density : d.band) amounts.band.push_back(plain(density));
  amounts.water_self = plain(d.water_self);
  amounts.water_self_cold = weighted(d.water_self, coldness);
  amounts.water_foreign = plain(d.water_foreign);
  amounts.nitrogen = plain(d.nitrogen);
  amounts.oxygen = plain(d.oxygen);
  amounts.oxygen_temperature = weighted(d.oxygen, above_220);
  amounts.oxygen_temperature_2 = weighted(d.oxygen, above_220_squared);
  amounts.oxygen_pairs = plain(d.oxygen_pairs);
  amounts.ozone = plain(d.ozone);
  amounts.ozone_temperature = weighted(d.ozone, celsius);
  amounts.ozone_temperature_2 = weighted(d.ozone, celsius_squared);
  amounts.nitrogen_dioxide = plain(d.nitrogen_dioxide);
  amounts.nitrogen_dioxide_temperature = weighted(d.nitrogen_dioxide, above_220);
  return amounts;
}

}  // namespace

void GasAmounts::add(const GasAmounts& other, double factor) {
  if (band.empty()) band.resize(other.band.size());
  for (std::size_t b = 0; b < band.size(); ++b) band[b] += factor * other.band[b];
  water_self += factor * other.water_self;
  water_self_cold += factor * other.water_self_cold;
  water_foreign += factor * other.water_foreign;
  nitrogen += factor * other.nitrogen;
  oxygen += factor * other.oxygen;
  oxygen_temperature += factor * other.oxygen_temperature;
  oxygen_temperature_2 += factor * other.oxygen_temperature_2;
  oxygen_pairs += factor * other.oxygen_pairs;
  ozone += factor * other.ozone;
  ozone_temperature += factor * other.ozone_temperature;
  ozone_temperature_2 += factor * other.ozone_temperature_2;
  nitrogen_dioxide += factor * other.nitrogen_dioxide;
  nitrogen_dioxide_temperature += factor * other.nitrogen_dioxide_temperature;
}

GasAmounts vertical_amounts(const Profile& profile, double first_km, double last_km) {
  return integrated(profile, densities_of(profile), first_km, last_km);
}

std::vector<GasAmounts> layer_amounts(const Profile& profile, const std::vector<double>& altitude_km) {
  const Densities densities = densities_of(profile);
  std::vector<GasAmounts> layers;
  for (std::size_t i = 0; i + 1 < altitude_km.size(); ++i)
    layers.push_back(integrated(profile, densities, altitude_km[i], altitude_km[i + 1]));
  return layers;
}

GasAmounts horizontal_amounts(const Profile& profile, double altitude, double length_km) {
  // A layer so thin that nothing changes in it, made as long as the path.
  constexpr double kThinKm = 1e-6;
  GasAmounts amounts;
  amounts.add(vertical_amounts(profile, altitude, altitude + kThinKm), length_km / kThinKm);
  return amounts;
}

double slant_factor(double start_km, double zenith_deg, double first_km, double last_km) {
  const double closest = (kEarthRadiusKm + start_km) * std::sin(zenith_deg * std::numbers::pi / 180.0);
  const auto along = [&](double altitude) {
    const double radius = kEarthRadiusKm + altitude;
    return std::sqrt(std::max((radius - closest) * (radius + closest), 0.0));
  };
  return (along(last_km) - along(first_km)) / (last_km - first_km);
}

GasAmounts slant_amounts(const Profile& profile, double first_km, double last_km, double zenith_deg) {
  const Profile part = profile.between(first_km, last_km);
  const std::vector<GasAmounts> layers = layer_amounts(profile, part.altitude_km);
  GasAmounts sum;
  for (std::size_t i = 0; i < layers.size(); ++i)
    sum.add(layers[i], slant_factor(first_km, zenith_deg, part.altitude_km[i], part.altitude_km[i + 1]));
  return sum;
}

}  // namespace ifov::atmosphere
