#include "atmosphere/sensor/model_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "atmosphere/column/light_limits.h"
#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/sensor/model_error_table.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "atmosphere/tables/table_text.h"
#include "core/error.h"
#include "core/format.h"
#include "radiometry/planck.h"

namespace ifov::data {
extern const std::string_view atmosphere_model_error;
}

namespace ifov::atmosphere {
namespace {

/// No depth is off by more than this share of itself.
constexpr double kMostOfDepth = 0.9;
/// Wavenumbers of a channel that are looked at, at most: the error is smooth.
constexpr std::size_t kMostBins = 8;
/// Cosine of the zenith angle at which the sky is as bright as its mean over a level surface's view (Elsasser's
/// diffusivity factor 1.66).
constexpr double kDiffuse = 1.0 / 1.66;

double gas_depth(double wavenumber_cm1, const GasAmounts& amounts, GasModel model) {
  constexpr double kOpaque = 1e-30;
  return -std::log(std::max(kOpaque, gas_transmittance(wavenumber_cm1, amounts, model)));
}

/// A path from an observer through successive levels.
struct LevelPath {
  std::vector<GasAmounts> amounts;  // from the observer to each level
  std::vector<double> temperature_K, air_mass, water_g_cm2;
};

double air_between(const Profile& profile, double first_km, double last_km) {
  return (profile.pressure_at(first_km) - profile.pressure_at(last_km)) / profile.pressure_hPa.front();
}

double water_between(const Profile& profile, double first_km, double last_km) {
  return profile.between(first_km, last_km).precipitable_water_g_cm2();
}

LevelPath level_path(const AtmosphereColumn& column, double from_km, double to_km, double slant) {
  const Profile& profile = column.profile();
  std::vector<double> z{from_km};
  for (const double level : column.levels().altitude_km)
    if (level > std::min(from_km, to_km) && level < std::max(from_km, to_km)) z.push_back(level);
  z.push_back(to_km);
  if (to_km > from_km)
    std::sort(z.begin(), z.end());
  else
    std::sort(z.rbegin(), z.rend());
  LevelPath path;
  GasAmounts sum = vertical_amounts(profile, from_km, from_km);
  double air = 0.0, water = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (i > 0) {
      const double low = std::min(z[i], z[i - 1]), high = std::max(z[i], z[i - 1]);
      sum.add(vertical_amounts(profile, low, high), slant);
      air += slant * air_between(profile, low, high);
      water += slant * water_between(profile, low, high);
    }
    path.amounts.push_back(sum);
    path.air_mass.push_back(air);
    path.water_g_cm2.push_back(water);
    path.temperature_K.push_back(profile.temperature_at(z[i]));
  }
  return path;
}

struct Emission {
  double radiance = 0.0, less = 0.0;
};

/// At a wavenumber, with the absorption of the column and with as much less as the table says.
Emission emission_of(const LevelPath& path, double nu, GasModel model, const ModelErrorTable& table) {
  const double um = 1e4 / nu;
  std::vector<double> planck, depth, less;
  for (std::size_t i = 0; i < path.amounts.size(); ++i) {
    planck.push_back(radiometry::planck_w_m2_sr_um(um, path.temperature_K[i]));
    depth.push_back(gas_depth(nu, path.amounts[i], model));
    less.push_back(depth[i] - table.of_depth(um, {path.air_mass[i], path.water_g_cm2[i], depth[i]}));
  }
  return {emission_of_levels(planck, depth), emission_of_levels(planck, less)};
}

/// Vertical extinction of the aerosol, without clouds, from the ground to an altitude.
double haze_depth_below(const LayerOptics& layers, const Levels& levels, double altitude_km) {
  double sum = 0.0;
  for (std::size_t l = 0; l < levels.layers(); ++l) {
    const double low = levels.altitude_km[l], high = levels.altitude_km[l + 1];
    const double share = std::clamp((altitude_km - low) / (high - low), 0.0, 1.0);
    sum += share * (layers.aerosol_scattering[l] + layers.aerosol_absorption[l]);
    if (!layers.cloud_scattering.empty())
      sum -= share * (layers.cloud_scattering[l] + layers.cloud_absorption[l]);
  }
  return sum;
}

/// The aerosol's of what the whole column scatters without clouds.
double haze_share(const LayerOptics& layers) {
  double haze = 0.0, all = 0.0;
  for (std::size_t l = 0; l < layers.aerosol_scattering.size(); ++l) {
    const double cloud = layers.cloud_scattering.empty() ? 0.0 : layers.cloud_scattering[l];
    haze += layers.aerosol_scattering[l] - cloud;
    all += layers.aerosol_scattering[l] - cloud + layers.rayleigh_scattering[l];
  }
  return all > 0.0 ? haze / all : 0.0;
}

std::vector<ModelErrorRow> read_rows(std::string_view text) {
  std::vector<ModelErrorRow> rows;
  for (const TableSection& section : parse_table_text(text)) {
    if (section.words.empty() || section.words.front() != "model_error") continue;
    constexpr std::size_t kColumns = 9;
    for (std::size_t i = 0; i + kColumns <= section.values.size(); i += kColumns) {
      const double* v = &section.values[i];
      rows.push_back({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]});
    }
  }
  return rows;
}

}  // namespace

double emission_of_levels(std::span<const double> planck, std::span<const double> depth) {
  double sum = 0.0;
  for (std::size_t i = 1; i < planck.size(); ++i)
    sum += 0.5 * (planck[i] + planck[i - 1]) * (std::exp(-depth[i - 1]) - std::exp(-depth[i]));
  return sum;
}

ModelErrorTable::ModelErrorTable(std::vector<ModelErrorRow> rows) : rows_(std::move(rows)) {
  if (rows_.empty()) throw InputError("the table of the model's error has no rows");
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ModelErrorRow& row = rows_[i];
    const bool rises = row.last_um > row.first_um && (i == 0 || row.first_um >= rows_[i - 1].last_um);
    const double least =
        std::min({row.missing, row.wet, row.gas, row.molecules, row.haze, row.emitted, row.floor});
    if (!rises || !(least >= 0.0))
      throw InputError(
          format("the table of the model's error: row {} ({:g} to {:g} um) does not follow the one "
                 "before or has a figure below 0",
                 i + 1, row.first_um, row.last_um));
  }
}

const ModelErrorTable& ModelErrorTable::built_in() {
  static const ModelErrorTable table(read_rows(data::atmosphere_model_error));
  return table;
}

const ModelErrorRow& ModelErrorTable::at(double wavelength_um) const {
  const auto after = std::upper_bound(rows_.begin(), rows_.end(), wavelength_um,
                                      [](double um, const ModelErrorRow& row) { return um < row.first_um; });
  return after == rows_.begin() ? *after : *std::prev(after);
}

double ModelErrorTable::of_depth(double wavelength_um, const PathContent& path) const {
  const ModelErrorRow& row = at(wavelength_um);
  return row.missing * path.air_mass + row.wet * path.water_g_cm2 +
         std::min(kMostOfDepth, row.gas) * path.gas_depth + row.haze * path.haze_depth;
}

double ModelErrorTable::of_scattered(double wavelength_um, double haze_share) const {
  const ModelErrorRow& row = at(wavelength_um);
  return row.molecules * (1.0 - haze_share) + row.haze * haze_share;
}

ChannelModelError channel_model_error(const AtmosphereColumn& column, std::span<const ChannelBin> bins,
                                      const BinOptics& optics, const SensorGeometry& geometry,
                                      const ModelErrorTable& table) {
  const Profile& profile = column.profile();
  const GasModel model = column.description().gas_model;
  const double ground = profile.ground_km(), top = kTopOfAtmosphereKm;
  const double sensor = std::clamp(geometry.sensor_altitude_km, ground, top);
  const double view_slant = 1.0 / std::cos(geometry.view_zenith_rad);
  constexpr double kLastLit_um =
      5.0;  // beyond, what surfaces reflect of the Sun is a hundredth of what they emit
  const bool sunlit = geometry.sun_zenith_rad && bins.front().wavelength_um < kLastLit_um;
  const bool glows = bins.back().wavelength_um >= kFirstThermal_um;
  const double end = std::max(sensor, ground + 1e-6);

  GasAmounts view = vertical_amounts(profile, ground, ground), sunny = view;
  view.add(vertical_amounts(profile, ground, end), view_slant);
  const double view_air = view_slant * air_between(profile, ground, end),
               view_water = view_slant * water_between(profile, ground, end);
  double sun_air = 0.0, sun_water = 0.0;
  if (geometry.sun_zenith_rad) {
    constexpr double kDegrees = 57.29577951308232, kLowest_deg = 89.9;
    const double zenith_deg = std::min(kLowest_deg, kDegrees * *geometry.sun_zenith_rad);
    sunny = slant_amounts(profile, ground, top, zenith_deg);
    sun_air = slant_factor(ground, zenith_deg, ground, ground + 8.0);  // the scale height of air
    sun_water = slant_factor(ground, zenith_deg, ground, ground + 2.0) * water_between(profile, ground, top);
  }
  GasAmounts both = view;
  both.add(sunny, 1.0);
  std::optional<LevelPath> down, up;
  if (glows) {
    down = level_path(column, end, ground, view_slant);
    up = level_path(column, ground, top, 1.0 / kDiffuse);
  }

  ChannelModelError error;
  const std::size_t step = (bins.size() + kMostBins - 1) / kMostBins;
  double shares = 0.0, seen = 0.0, seen_less = 0.0, lit = 0.0, lit_less = 0.0;
  for (std::size_t b = step / 2; b < bins.size(); b += step) {
    const double nu = bins[b].wavenumber_cm1, um = 1e4 / nu, share = bins[b].share;
    shares += share;
    const double one = gas_depth(nu, view, model);
    seen += share * std::exp(-one);
    // The aerosol's on the way to the sensor alone: what it takes of the beam on the way down comes as skylight.
    const LayerOptics& layers = optics.at(bins[b]).scattering;
    const double haze = view_slant * haze_depth_below(layers, column.levels(), end);
    seen_less += share * std::exp(-one + table.of_depth(um, {view_air, view_water, one, haze}));
    if (sunlit) {
      const double two = gas_depth(nu, both, model);
      lit += share * std::exp(-two);
      lit_less += share * std::exp(-two + table.of_depth(
                                              um, {view_air + sun_air, view_water + sun_water, two, haze}));
      const double hazy = haze_share(layers);
      error.scattered += share * table.of_scattered(um, hazy);
      error.by_shape += share * hazy * column.aerosol().scattering_error(um);
      error.scattered_floor +=
          share * table.at(um).floor * bins[b].irradiance * geometry.sun_sine() / std::numbers::pi;
    }
    if (!glows) continue;
    const Emission path = emission_of(*down, nu, model, table), sky = emission_of(*up, nu, model, table);
    error.emission += share * path.radiance;
    error.emission_less += share * (path.less - path.radiance);
    error.sky_emission += share * sky.radiance;
    error.emission_other += share * table.at(um).emitted * path.radiance;
    error.sky_change += share * (std::abs(sky.less - sky.radiance) + table.at(um).emitted * sky.radiance);
  }
  if (!(shares > 0.0)) return error;
  error.surface = seen > 0.0 ? seen_less / seen - 1.0 : 0.0;
  if (lit > 0.0) error.sunlight = std::max(0.0, lit_less / lit - 1.0 - error.surface);
  // Scattered sunlight meets the gases on a part of the way; it is off by no more than reflected sunlight is.
  error.scattered = error.scattered / shares + error.sunlight;
  error.by_shape /= shares;
  for (double* value : {&error.scattered_floor, &error.emission, &error.emission_less, &error.emission_other,
                        &error.sky_emission, &error.sky_change})
    *value /= shares;
  return error;
}

}  // namespace ifov::atmosphere
