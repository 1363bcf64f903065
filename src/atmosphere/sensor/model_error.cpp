#include "atmosphere/sensor/model_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "atmosphere/column/light_limits.h"
#include "atmosphere/column/tabulated_gases.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/particles/cloud_error.h"
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
/// A sensor at a cloud's top is above it.
constexpr double kWithin_km = 1e-3;
/// Cosine of the zenith angle at which the sky is as bright as its mean over a level surface's view (Elsasser's
/// diffusivity factor 1.66).
constexpr double kDiffuse = 1.0 / 1.66;

constexpr double kOpaque = 1e-30;

/// What absorbs along a path: bands and continua in closed form, and terms of a table (one of depth 0 without any), with what of
/// these depths may be too much. Clouds absorb in all terms alike.
struct PathDepth {
  double bands = 0.0, clouds = 0.0;
  std::vector<double> weight, terms, terms_off;
  double gases() const {
    return transmitted([](double, double) { return 0.0; }, 0.0);
  }
  /// With so much less of the bands' and the clouds'.
  double gases_less(double of_bands) const {
    return transmitted([](double depth, double off) { return std::min(off, kMostOfDepth * depth); },
                       of_bands);
  }

 private:
  template <class Less>
  double transmitted(const Less& less, double of_bands) const {
    double sum = 0.0;
    for (std::size_t t = 0; t < weight.size(); ++t)
      sum += weight[t] * std::exp(-terms[t] + less(terms[t], terms_off[t]));
    return sum * std::exp(-bands + of_bands);
  }
};

/// Gases of a column at a wavenumber: those of its table of terms, layer by layer, and all others.
class GasesAt {
 public:
  GasesAt(const AtmosphereColumn& column, double nu, const ModelErrorTable& table)
      : column_(column), nu_(nu), tabulated_(tabulated_gases(column, nu, table.at(1e4 / nu).gas)) {}

  /// `crossed(low, high)`: length of the way through a layer over its height.
  template <class Crossed>
  PathDepth along(const GasAmounts& amounts, const Crossed& crossed) const {
    PathDepth path{
        -std::log(std::max(kOpaque, band_transmittance(column_, nu_, amounts))), 0.0, {1.0}, {0.0}, {0.0}};
    if (!tabulated_) return path;
    const std::vector<double>& z = column_.levels().altitude_km;
    path.weight = tabulated_->lines.weight;
    path.terms.assign(path.weight.size(), 0.0);
    path.terms_off = path.terms;
    for (std::size_t l = 0; l + 1 < z.size(); ++l) {
      const double share = crossed(z[l], z[l + 1]);
      for (std::size_t t = 0; share > 0.0 && t < path.terms.size(); ++t) {
        path.terms[t] += share * tabulated_->lines.depth[t][l];
        path.terms_off[t] += share * tabulated_->off.depth[t][l];
      }
    }
    return path;
  }
  /// Of what the table of the model's error says of water without lines, what holds beside a table that has its continuum.
  double water_without_lines(double water_g_cm2) const {
    if (!tabulated_) return water_g_cm2;
    for (const TermGas& gas : column_.gas_terms()->gases)
      if (gas.gas == Gas::h2o && gas.holds_continuum && gas.depth_error) return 0.0;
    return water_g_cm2;
  }

 private:
  const AtmosphereColumn& column_;
  double nu_;
  std::optional<TabulatedGases> tabulated_;
};

/// Of a layer what lies between two altitudes, times the slant of the way.
auto between(double first_km, double last_km, double slant) {
  return [=](double low, double high) {
    const double inside =
        std::min(high, std::max(first_km, last_km)) - std::max(low, std::min(first_km, last_km));
    return slant * std::max(0.0, inside) / (high - low);
  };
}

/// A path from an observer through successive levels.
struct LevelPath {
  double slant = 1.0;
  std::vector<double> altitude_km;
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
  path.slant = slant;
  path.altitude_km = z;
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

/// What clouds between two altitudes absorb, straight up.
double cloud_absorption(const AerosolColumn& aerosol, double um, double first_km, double last_km) {
  double sum = 0.0;
  for (std::size_t r = aerosol.first_cloud(); r < aerosol.regions(); ++r)
    sum += aerosol.thickness_550(r, std::min(first_km, last_km), std::max(first_km, last_km)) *
           aerosol.properties(r, um).absorption;
  return sum;
}

/// With the absorption of the column and with as much less as the table, and the clouds' error, say.
Emission emission_of(const AtmosphereColumn& column, const LevelPath& path, double nu, const GasesAt& gases,
                     const ModelErrorTable& table, const CloudError& clouds) {
  const double um = 1e4 / nu;
  std::vector<double> planck;
  std::vector<PathDepth> depths;
  std::vector<double> less;
  for (std::size_t i = 0; i < path.amounts.size(); ++i) {
    planck.push_back(radiometry::planck_w_m2_sr_um(um, path.temperature_K[i]));
    depths.push_back(
        gases.along(path.amounts[i], between(path.altitude_km.front(), path.altitude_km[i], path.slant)));
    const double cloudy =
        path.slant * cloud_absorption(column.aerosol(), um, path.altitude_km.front(), path.altitude_km[i]);
    less.push_back(table.of_depth(um, {path.air_mass[i], gases.water_without_lines(path.water_g_cm2[i]),
                                       depths[i].bands}) +
                   std::min(kMostOfDepth, clouds.absorbed) * cloudy);
    depths[i].clouds = cloudy;
  }
  Emission sum;
  std::vector<double> as_is(depths.size()), lessened(depths.size());
  for (std::size_t t = 0; t < depths.front().weight.size(); ++t) {
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const double term = depths[i].terms[t];
      as_is[i] = depths[i].bands + depths[i].clouds + term;
      lessened[i] = as_is[i] - less[i] - std::min(depths[i].terms_off[t], kMostOfDepth * term);
    }
    sum.radiance += depths.front().weight[t] * emission_of_levels(planck, as_is);
    sum.less += depths.front().weight[t] * emission_of_levels(planck, lessened);
  }
  return sum;
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

/// What the column sends back of diffuse light without its clouds.
double air_reflects(const LayerOptics& layers) {
  double scattered = 0.0, absorbed = 0.0, forward = 0.0;
  for (std::size_t l = 0; l < layers.aerosol_scattering.size(); ++l) {
    const bool cloudy = !layers.cloud_scattering.empty();
    const double haze = layers.aerosol_scattering[l] - (cloudy ? layers.cloud_scattering[l] : 0.0);
    scattered += haze + layers.rayleigh_scattering[l];
    absorbed += layers.aerosol_absorption[l] - (cloudy ? layers.cloud_absorption[l] : 0.0);
    constexpr double kHaze = 0.65;  // asymmetry: that of the layer has its clouds
    forward += kHaze * haze;
  }
  const double depth = scattered + absorbed;
  return depth > 0.0 && scattered > 0.0 ? two_streams(depth, scattered / depth, forward / scattered).reflected
                                        : 0.0;
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
  constexpr double kDegrees = 57.29577951308232, kLowest_deg = 89.9;
  const double zenith_deg = std::min(kLowest_deg, kDegrees * geometry.sun_zenith_rad.value_or(0.0));
  if (geometry.sun_zenith_rad) {
    sunny = slant_amounts(profile, ground, top, zenith_deg);
    sun_air = slant_factor(ground, zenith_deg, ground, ground + 8.0);  // the scale height of air
    sun_water = slant_factor(ground, zenith_deg, ground, ground + 2.0) * water_between(profile, ground, top);
  }
  GasAmounts both = view;
  both.add(sunny, 1.0);
  const auto on_view = between(ground, end, view_slant);
  const auto on_both = [&](double low, double high) {
    return on_view(low, high) + slant_factor(ground, zenith_deg, low, high);
  };
  std::optional<LevelPath> down, up;
  if (glows) {
    down = level_path(column, end, ground, view_slant);
    up = level_path(column, ground, top, 1.0 / kDiffuse);
  }

  ChannelModelError error;
  error.of_bands = column.gas_terms() != nullptr && !column.gas_terms()->depth_errors_known();
  const std::size_t step = (bins.size() + kMostBins - 1) / kMostBins;
  double shares = 0.0, cloudy_view = 0.0, cloudy_light = 0.0, seen = 0.0, seen_less = 0.0, lit = 0.0,
         lit_less = 0.0;
  for (std::size_t b = step / 2; b < bins.size(); b += step) {
    const double nu = bins[b].wavenumber_cm1, um = 1e4 / nu, share = bins[b].share;
    shares += share;
    const GasesAt gases(column, nu, table);
    const PathDepth one = gases.along(view, on_view);
    seen += share * one.gases();
    // The aerosol's on the way to the sensor alone: what it takes of the beam on the way down comes as skylight.
    const LayerOptics& layers = optics.at(bins[b]).scattering;
    const double haze = view_slant * haze_depth_below(layers, column.levels(), end);
    const double wet = gases.water_without_lines(view_water);
    seen_less += share * one.gases_less(table.of_depth(um, {view_air, wet, one.bands, haze}));
    const double other = air_reflects(layers);
    const CloudError clouds =
        column.aerosol().cloudy() ? cloud_error(column.aerosol(), um, other) : CloudError{};
    const bool over_clouds = sensor > column.aerosol().cloud_top_km() - kWithin_km;
    if (over_clouds) cloudy_view += share * std::expm1(std::min(1.0, view_slant * clouds.extinction));
    if (sunlit) {
      const PathDepth two = gases.along(both, on_both);
      lit += share * two.gases();
      lit_less +=
          share *
          two.gases_less(table.of_depth(
              um, {view_air + sun_air, gases.water_without_lines(view_water + sun_water), two.bands, haze}));
      cloudy_light += share * clouds.all_below;
      error.by_clouds += share * (over_clouds ? clouds.above : std::max(clouds.above, clouds.all_below));
      error.sky_by_clouds += share * clouds.below;
      const double hazy = haze_share(layers);
      error.scattered += share * table.of_scattered(um, hazy);
      error.by_shape += share * hazy * haze_error(column.aerosol(), um);
      error.scattered_floor +=
          share * table.at(um).floor * bins[b].irradiance * geometry.sun_sine() / std::numbers::pi;
    }
    if (!glows) continue;
    const Emission path = emission_of(column, *down, nu, gases, table, clouds),
                   sky = emission_of(column, *up, nu, gases, table, clouds);
    error.emission += share * path.radiance;
    error.emission_less += share * (path.less - path.radiance);
    error.sky_emission += share * sky.radiance;
    error.emission_other += share * (table.at(um).emitted + clouds.reflected) * path.radiance;
    error.sky_change += share * (std::abs(sky.less - sky.radiance) +
                                 (table.at(um).emitted + clouds.reflected) * sky.radiance);
  }
  if (!(shares > 0.0)) return error;
  error.surface = seen > 0.0 ? seen_less / seen - 1.0 : 0.0;
  if (lit > 0.0) error.sunlight = std::max(0.0, lit_less / lit - 1.0 - error.surface);
  // Scattered sunlight meets the gases on a part of the way; it is off by no more than reflected sunlight is.
  error.scattered = error.scattered / shares + error.sunlight;
  error.surface += cloudy_view / shares;
  error.sunlight += cloudy_light / shares;
  error.by_clouds /= shares;
  error.sky_by_clouds /= shares;
  error.by_shape /= shares;
  for (double* value : {&error.scattered_floor, &error.emission, &error.emission_less, &error.emission_other,
                        &error.sky_emission, &error.sky_change})
    *value /= shares;
  return error;
}

}  // namespace ifov::atmosphere
