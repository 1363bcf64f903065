#include "thermal/surface_balance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "thermal/faces/sky_longwave.h"
#include "thermal/faces/time_table.h"

namespace ifov::thermal {
namespace {

double black_w_m2(double temperature_k) {
  const double squared = temperature_k * temperature_k;
  return kStefanBoltzmann_w_m2_k4 * squared * squared;
}

double cos_incidence(const Outdoors& now, const Stand& stand, bool two_faces) {
  if (now.sun_elevation_rad <= 0.0) return 0.0;
  const double cosine = std::sin(now.sun_elevation_rad) * std::cos(stand.tilt_rad) +
                        std::cos(now.sun_elevation_rad) * std::sin(stand.tilt_rad) *
                            std::cos(now.sun_azimuth_rad - stand.azimuth_rad);
  return two_faces ? std::abs(cosine) : std::max(0.0, cosine);
}

double open_share(double cos_tilt, bool two_faces) { return two_faces ? 1.0 : 0.5 * (1.0 + cos_tilt); }

double global_w_m2(const Outdoors& now) {
  return now.diffuse_w_m2 + now.direct_w_m2 * std::max(0.0, std::sin(now.sun_elevation_rad));
}

/// As steep as keeps a melting surface within some hundredths of a kelvin, and Newton's method in its stride.
constexpr double kMelting_w_m2_k = 1e4;

/// As stiff as keeps what is held within a thousandth of a kelvin of it.
constexpr double kHolding_w_m2_k = 1e6;

double mix(double a, double b, double share) { return a + share * (b - a); }

}  // namespace

FromBeside of_level_ground(const Outdoors& now, const Stand& stand) {
  return {stand.ground_reflectance * global_w_m2(now), black_w_m2(now.air.temperature_k)};
}

SurfaceBalance::SurfaceBalance(const OutdoorsSeries& series, const Skin& skin, const Stand& stand,
                               std::vector<double> visibility, std::vector<double> free_sky,
                               std::vector<FromBeside> beside)
    : begin_s_(series.begin_s), step_s_(series.step_s), cos_tilt_(std::cos(stand.tilt_rad)), skin_(skin) {
  rows_.reserve(series.rows.size());
  full_sun_.reserve(series.rows.size());
  for (std::size_t i = 0; i < series.rows.size(); ++i)
    rows_.push_back(row_of(series, stand, i, visibility.empty() ? 1.0 : visibility[i],
                           free_sky.empty() ? stand.free_sky : free_sky[i],
                           beside.empty() ? nullptr : &beside[i]));
}

SurfaceBalance::Row SurfaceBalance::row_of(const OutdoorsSeries& series, const Stand& stand,
                                           std::size_t index, double visibility, double free_sky,
                                           const FromBeside* beside) {
  const Outdoors& now = series.rows[index];
  const double sky_view = free_sky * open_share(cos_tilt_, skin_.two_faces);
  const double ground_view = skin_.faces() - sky_view;
  FromBeside from_ground = of_level_ground(now, stand);
  from_ground.sunlight_w_m2 *= ground_view;
  from_ground.longwave_w_m2 *= ground_view;
  if (beside == nullptr) beside = &from_ground;
  full_sun_.push_back(skin_.solar_absorptance * now.direct_w_m2 * cos_incidence(now, stand, skin_.two_faces));
  Row row;
  row.given.sun = visibility * full_sun_.back();
  row.given.sky = skin_.solar_absorptance * now.diffuse_w_m2 * sky_view;
  row.given.reflected = skin_.solar_absorptance * beside->sunlight_w_m2;
  row.given.sky_longwave = skin_.emissivity * now.longwave_w_m2 * sky_view;
  row.given.ground_longwave = skin_.emissivity * beside->longwave_w_m2;
  row.given.power = skin_.power_w_m2;
  const double time_s = series.begin_s + static_cast<double>(index) * series.step_s;
  if (skin_.as_air) row.held_k = now.air.temperature_k;
  if (skin_.held_k)
    row.held_k = skin_.held_k->mean(time_s - 0.5 * series.step_s, time_s + 0.5 * series.step_s);
  if (skin_.power_over_time) {
    row.given.power = skin_.power_over_time->mean(time_s - 0.5 * series.step_s, time_s + 0.5 * series.step_s);
  }
  row.air = now.air;
  const double wind_m_s = wind_at_m_s(now.wind_m_s, series.anemometer, stand.height_m, stand.terrain);
  if (skin_.leaf.width_m > 0.0) {
    row.open_stomata = std::min(1.0, global_w_m2(now) / kLightOfOpenStomata_w_m2);
    row.forced_w_m2_k = row.forced_back_w_m2_k = leaf_forced_convection(wind_m_s, skin_.leaf.width_m);
    return row;
  }
  const auto forced_w_m2_k = [&](double tilt_rad, double azimuth_rad) {
    return forced_convection(wind_m_s, windward_share(tilt_rad, azimuth_rad, now.wind_from_rad));
  };
  row.forced_w_m2_k = forced_w_m2_k(stand.tilt_rad, stand.azimuth_rad);
  if (!skin_.two_faces) return row;
  // What is level meets the wind with both faces.
  const double back_tilt_rad = std::numbers::pi - stand.tilt_rad,
               steep_rad = std::min(stand.tilt_rad, back_tilt_rad);
  if (windward_share(steep_rad, 0.0, std::numbers::pi, 0.0) == 1.0)
    row.forced_w_m2_k = row.forced_back_w_m2_k = forced_w_m2_k(steep_rad, stand.azimuth_rad);
  else
    row.forced_back_w_m2_k = forced_w_m2_k(back_tilt_rad, stand.azimuth_rad + std::numbers::pi);
  return row;
}

double SurfaceBalance::of_free_sky_w_m2(const Outdoors& now, const Skin& skin, double ground_reflectance) {
  return skin.solar_absorptance * (now.diffuse_w_m2 - ground_reflectance * global_w_m2(now)) +
         skin.emissivity * (now.longwave_w_m2 - black_w_m2(now.air.temperature_k));
}

const SurfaceBalance::Row& SurfaceBalance::at(double time_s, Row& between) const {
  const double last = static_cast<double>(rows_.size() - 1);
  const double place = std::clamp((time_s - begin_s_) / step_s_, 0.0, last);
  const auto i = static_cast<std::size_t>(std::min(std::floor(place), std::max(0.0, last - 1.0)));
  const double share = place - static_cast<double>(i);
  if (share == 0.0) return rows_[i];
  const Row &a = rows_[i], &b = rows_[i + 1];
  if (share == 1.0) return b;
  Row& row = between = a;
  row.given.sun = mix(a.given.sun, b.given.sun, share);
  row.given.sky = mix(a.given.sky, b.given.sky, share);
  row.given.reflected = mix(a.given.reflected, b.given.reflected, share);
  row.given.sky_longwave = mix(a.given.sky_longwave, b.given.sky_longwave, share);
  row.given.ground_longwave = mix(a.given.ground_longwave, b.given.ground_longwave, share);
  row.air.temperature_k = mix(a.air.temperature_k, b.air.temperature_k, share);
  row.air.vapour_pa = mix(a.air.vapour_pa, b.air.vapour_pa, share);
  row.air.pressure_pa = mix(a.air.pressure_pa, b.air.pressure_pa, share);
  row.forced_w_m2_k = mix(a.forced_w_m2_k, b.forced_w_m2_k, share);
  row.held_k = mix(a.held_k, b.held_k, share);
  row.open_stomata = mix(a.open_stomata, b.open_stomata, share);
  row.forced_back_w_m2_k = mix(a.forced_back_w_m2_k, b.forced_back_w_m2_k, share);
  return row;
}

Fluxes SurfaceBalance::complete(const Row& row, double surface_k, double& slope) const {
  Fluxes fluxes = row.given;
  fluxes.emitted = -skin_.faces() * skin_.emissivity * black_w_m2(surface_k);
  slope = 4.0 * fluxes.emitted / std::max(surface_k, 1.0);
  const double warmer_k = surface_k - row.air.temperature_k;
  const auto of_face = [&](double cos_tilt, double forced_w_m2_k) {
    return skin_.leaf.width_m > 0.0 ? leaf_convection(warmer_k, cos_tilt, forced_w_m2_k, skin_.leaf.width_m)
                                    : convection(warmer_k, cos_tilt, forced_w_m2_k, skin_.roughness);
  };
  const Coefficient front = of_face(cos_tilt_, row.forced_w_m2_k);
  Coefficient back;
  if (skin_.two_faces) back = of_face(-cos_tilt_, row.forced_back_w_m2_k);
  for (const Coefficient& h : {front, back}) {
    fluxes.convection -= skin_.convecting_faces * h.h_w_m2_k * warmer_k;
    slope -= skin_.convecting_faces * (h.h_w_m2_k + h.slope_w_m2_k2 * warmer_k);
    if (skin_.leaf.width_m > 0.0) continue;
    const LatentHeat latent = latent_heat(skin_.wetness, surface_k, row.air, h);
    fluxes.latent -= latent.w_m2;
    slope -= latent.slope_w_m2_k;
  }
  if (skin_.leaf.width_m > 0.0) {
    Leaf leaf = skin_.leaf;
    leaf.stomatal_mol_m2_s *= row.open_stomata;
    const LatentHeat latent = leaf_latent_heat(leaf, surface_k, row.air, front, back);
    fluxes.latent -= latent.w_m2;
    slope -= latent.slope_w_m2_k;
  }
  if (surface_k > skin_.melts_k) {
    fluxes.latent -= kMelting_w_m2_k * (surface_k - skin_.melts_k);
    slope -= kMelting_w_m2_k;
  }
  if (!std::isnan(row.held_k)) {
    fluxes.power -= kHolding_w_m2_k * (surface_k - row.held_k);
    slope -= kHolding_w_m2_k;
  }
  return fluxes;
}

SurfaceGain SurfaceBalance::gain(double time_s, double surface_k) const {
  double slope = 0.0;
  Row between;
  const Fluxes fluxes = complete(at(time_s, between), surface_k, slope);
  return {fluxes.sum(), slope};
}

Fluxes SurfaceBalance::fluxes(double time_s, double surface_k) const {
  double slope = 0.0;
  Row between;
  return complete(at(time_s, between), surface_k, slope);
}

}  // namespace ifov::thermal
