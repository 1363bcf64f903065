#include "atmosphere/sensor/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "atmosphere/column/light_limits.h"
#include "atmosphere/scattering/round_earth_error.h"
#include "atmosphere/scattering/shell_line_of_sight.h"
#include "atmosphere/scattering/sky_ring.h"
#include "atmosphere/sensor/sky_table_error.h"
#include "atmosphere/thermal/thermal_column.h"
#include "core/parallel.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

/// Channels whose sky is looked at between the directions of the table.
constexpr std::size_t kSkiesLookedAt = 6;
/// A grey surface of 300 K, which light that comes down and light that it emits are weighed by.
constexpr double kGrey = 0.3, kGrey_k = 300.0;

double mean(const std::vector<double>& share, const std::vector<double>& values) {
  return std::inner_product(share.begin(), share.end(), values.begin(), 0.0);
}
double part_of(double difference, double whole) {
  return whole > 0.0 ? std::min(1.0, std::abs(difference) / whole) : 0.0;
}

/// Sunlight scattered once into the line of sight, by point.
std::vector<double> scattered_once(const AtmosphereColumn& column, const ChannelPoints& points,
                                   const SensorGeometry& geometry, const ScatteringOptions& options) {
  std::vector<double> once(points.size(), 0.0);
  const Propagation up{std::cos(geometry.view_zenith_rad), geometry.view_azimuth_rad - std::numbers::pi};
  const std::vector<double>& levels_km = column.levels().altitude_km;
  const std::vector<double> falling_km(levels_km.rbegin(), levels_km.rend());
  const ShellLineOfSight line(falling_km, options.spherical_earth, std::cos(geometry.any_sun_zenith_rad()),
                              up, {levels_km.front(), geometry.sensor_altitude_km});
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!geometry.sun_zenith_rad || points.points[p].wavelength_um > kLastSolar_um) continue;
    const ScatteringColumn layers = ScatteringColumn::of_layers(column.levels(), points.points[p].layers(),
                                                                *geometry.sun_zenith_rad, options);
    once[p] = points.irradiance[p] * single_scattering(layers, options.aerosol_polarization, line).single.i;
  }
  return once;
}

RoundEarthAir round_earth_air(const ChannelPoints& points) {
  RoundEarthAir air{points.cloudy(), 0.0, 0.0};
  for (std::size_t p = 0; p < points.size(); ++p) {
    const LayerOptics& layers = points.points[p].layers();
    const auto sum = [](const std::vector<double>& depth) {
      return std::accumulate(depth.begin(), depth.end(), 0.0);
    };
    air.molecules += points.share[p] * sum(layers.rayleigh_scattering);
    air.haze += points.share[p] * sum(layers.aerosol_scattering);
  }
  return air;
}

/// What clouds high above the ground scatter, of all that clouds take.
double scattered_high(const ChannelPoints& points, const Levels& levels) {
  constexpr double kHigh_km = 5.0;
  double high = 0.0, all = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const LayerOptics& layers = points.points[p].layers();
    for (std::size_t k = 0; k < layers.cloud_scattering.size(); ++k) {
      const double share = points.share[p];
      all += share * (layers.cloud_scattering[k] + layers.cloud_absorption[k]);
      if (levels.altitude_km[k] - levels.altitude_km.front() >= kHigh_km)
        high += share * layers.cloud_scattering[k];
    }
  }
  return all > 0.0 ? high / all : 0.0;
}

/// What is known at every point without a solution: means over the channel.
struct ExactLight {
  double surface = 0.0;   ///< of the grey surface, in the direct beam and its own light and the air's
  double once = 0.0;      ///< sunlight scattered once into the path
  double emission = 0.0;  ///< of the path
  ExactLight(const ChannelPoints& points, const ChannelEmission* emitted, const SensorGeometry& geometry,
             const std::vector<double>& scattered_once)
      : once(mean(points.share, scattered_once)) {
    const double sine = geometry.sun_sine();
    for (std::size_t p = 0; p < points.size(); ++p) {
      double light = kGrey * sine * points.sun[p] / std::numbers::pi;
      if (emitted != nullptr) {
        light += kGrey * emitted->sky_irradiance[p] / std::numbers::pi +
                 (1.0 - kGrey) * radiometry::planck_w_m2_sr_um(points.points[p].wavelength_um, kGrey_k);
        emission += points.share[p] * emitted->path[p];
      }
      surface += points.share[p] * points.view[p] * light;
    }
  }
};

class Estimate {
 public:
  Estimate(const ErrorQuestion& question, std::span<const std::vector<ChannelBin>> bins,
           std::span<const ChannelLights> channels)
      : question_(question), bins_(bins), channels_(channels), errors_(channels.size()) {}

  std::vector<AtmosphereErrors> made() {
    std::vector<std::vector<double>> asked(channels_.size());
    std::vector<std::size_t> unknown;
    for (std::size_t c = 0; c < channels_.size(); ++c)
      if (asked[c] = question_of(c); !known(asked[c], errors_[c].absorption)) unknown.push_back(c);
    if (!unknown.empty()) {
      const BinOptics optics(question_.finer.column(), bins_, question_.threads);
      parallel_for(static_cast<std::int64_t>(unknown.size()), question_.threads, [&](std::int64_t k) {
        const std::size_t channel = unknown[static_cast<std::size_t>(k)];
        absorption(channel, optics);
        keep(asked[channel], errors_[channel].absorption);
      });
    }
    parallel_for(static_cast<std::int64_t>(channels_.size()), question_.threads, [&](std::int64_t k) {
      const std::size_t channel = static_cast<std::size_t>(k);
      tabulated_terms(channel);
      scattering(channel);
    });
    skies();
    return std::move(errors_);
  }

 private:
  /// All that the error of absorption depends on: the column as it was solved at the channel's points, and
  /// what they gave.
  std::vector<double> question_of(std::size_t channel) const {
    const ChannelLights& given = channels_[channel];
    std::vector<double> asked =
        solution_question(question_.scattering, question_.geometry, question_.column.levels(),
                          given.points.points.front().layers());
    const double mean_path = given.scattering ? mean(given.points.share, given.scattered.path) : 0.0;
    asked.insert(asked.end(), {question_.geometry.sun_zenith_rad.value_or(-1.0), mean_path});
    for (const ChannelPoints::Point& point : given.points.points) asked.push_back(point.wavelength_um);
    for (const std::vector<double>* list : {&given.points.share, &given.points.irradiance, &given.points.sun,
                                            &given.points.view, &given.points.gas_depth})
      asked.insert(asked.end(), list->begin(), list->end());
    if (given.emitted) {
      asked.insert(asked.end(), given.emitted->path.begin(), given.emitted->path.end());
      asked.insert(asked.end(), given.emitted->sky_irradiance.begin(), given.emitted->sky_irradiance.end());
    }
    return asked;
  }
  bool known(const std::vector<double>& asked, AtmosphereError& error) const {
    double answer[3];
    if (question_.kept == nullptr || !question_.kept->find(asked, answer)) return false;
    error = {answer[0], answer[1], answer[2]};
    return true;
  }
  void keep(const std::vector<double>& asked, const AtmosphereError& error) const {
    const double answer[3] = {error.path, error.surface, error.sky};
    if (question_.kept != nullptr) question_.kept->keep(asked, answer);
  }

  void absorption(std::size_t channel, const BinOptics& optics) {
    const ChannelLights& given = channels_[channel];
    const AtmosphereColumn& column = question_.finer.column();
    const ChannelPoints points(column, bins_[channel], optics, question_.geometry);
    std::optional<ChannelEmission> emitted;
    if (given.emitted) emitted.emplace(column, points, question_.geometry, SkyDirections{});
    const SensorGeometry& geometry = question_.geometry;
    const std::vector<double> none(given.points.size(), 0.0);
    // What is scattered of the air's own light is judged with all else that is scattered.
    const ChannelEmission* glow = given.emitted ? &*given.emitted : nullptr;
    std::optional<ChannelEmission> straight;
    if (glow != nullptr && given.own_scattering) {
      straight.emplace(question_.column, given.points, geometry, SkyDirections{});
      glow = &*straight;
    }
    const ExactLight right(points, emitted ? &*emitted : nullptr, geometry,
                           scattered_once(column, points, geometry, question_.scattering));
    const ExactLight ours(given.points, glow, geometry, given.scattering ? given.scattered.once : none);
    const double scattered = given.scattering ? mean(given.points.share, given.scattered.path) : 0.0;
    errors_[channel].absorption = {
        part_of(ours.once - right.once, right.once) * scattered + std::abs(ours.emission - right.emission),
        part_of(ours.surface - right.surface, right.surface), 0.0};
  }

  /// By gases alone: straight through a cloud next to nothing comes, and what comes by other ways is known as well.
  double through_gases(const ChannelPoints& points, std::size_t p, bool day) const {
    const SensorGeometry& geometry = question_.geometry;
    constexpr double kLowest = 0.1;
    const double view = 1.0 / std::cos(geometry.view_zenith_rad),
                 sun = day ? 1.0 / std::max(kLowest, std::cos(geometry.any_sun_zenith_rad())) : 0.0;
    return (day ? points.irradiance[p] : 1.0) * std::exp(-(view + sun) * points.gas_depth[p]);
  }

  /// On top, what a table of terms says that it is off by: of transmittance, taken to have one sign in all bins.
  void tabulated_terms(std::size_t channel) {
    const ChannelLights& given = channels_[channel];
    const ChannelPoints& points = given.points;
    double error = 0.0, through = 0.0, emitted = 0.0;
    const bool day = mean(points.share, points.sun) > 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double off = points.share[p] * points.points[p].optics->terms_error;
      error += off * (day ? points.irradiance[p] : 1.0);
      through += points.share[p] * (!points.cloudy() ? (day ? points.sun[p] : 1.0) * points.view[p]
                                                     : through_gases(points, p, day));
      if (points.points[p].wavelength_um >= kFirstThermal_um)
        emitted += off * radiometry::planck_w_m2_sr_um(points.points[p].wavelength_um, kGrey_k);
    }
    if (!(error > 0.0)) return;
    const double of_surface = part_of(error, through);
    const double scattered = given.scattering ? mean(points.share, given.scattered.path) : 0.0;
    errors_[channel].absorption.surface += of_surface;
    errors_[channel].absorption.path += of_surface * scattered + emitted;
  }

  void scattering(std::size_t channel) {
    const ChannelLights& given = channels_[channel];
    if (!given.checks) return;
    ChannelChecks::Errors errors =
        given.checks->against(given.scattered, given.emitted ? &*given.emitted : nullptr);
    if (question_.scattering.spherical_earth && question_.geometry.sun_zenith_rad) {
      const RoundEarthError round =
          round_earth_error(*question_.geometry.sun_zenith_rad, round_earth_air(given.points));
      errors.path += round.path;
      errors.sky_irradiance += round.sky;
    }
    const ChannelPoints& points = given.points;
    if (question_.scattering.spherical_earth && given.emitted) {
      double slanted = question_.geometry.view_zenith_rad;
      for (const LineOfSight& line : question_.geometry.lines_of_sight)
        slanted = std::max(slanted, line.zenith_rad);
      const RoundEarthError glow = glow_error(slanted, scattered_high(points, question_.column.levels()));
      errors.emitted_path += glow.path;
      errors.emitted_sky += glow.sky;
    }
    const double sine = question_.geometry.sun_sine();
    std::vector<double> reflectance, glow;
    for (const ChannelPoints::Point& point : points.points)
      reflectance.push_back(question_.grounds[channel].at(point.wavelength_um));
    for (const ChannelPoints::Point& point : points.points)
      glow.push_back(point.wavelength_um < kFirstThermal_um
                         ? 0.0
                         : radiometry::planck_w_m2_sr_um(point.wavelength_um, kGrey_k));
    const double ground = mean(points.share, reflectance);
    const double albedo = mean(points.share, given.scattered.spherical_albedo);
    const double scattered = mean(points.share, given.scattered.sky_irradiance);
    const double sky = mean(points.share, given.sky_irradiance());
    const double all = sine * mean(points.share, points.sun) + sky;
    const double back = ground * albedo / (1.0 - ground * albedo);
    const double groundlit = mean(points.share, given.scattered.diffuse_transmittance);
    const double glow_of_path = given.emitted ? mean(points.share, given.emitted->path) : 0.0;
    const double glow_of_sky = given.emitted ? mean(points.share, given.emitted->sky_irradiance) : 0.0;
    errors_[channel].scattering = {
        errors.path * mean(points.share, given.scattered.path) + errors.emitted_path * glow_of_path +
            errors.diffuse_transmittance * groundlit *
                (ground * all * (1.0 + back) / std::numbers::pi + (1.0 - ground) * mean(points.share, glow)),
        errors.spherical_albedo * back,
        sky > 0.0 ? (errors.sky_irradiance * scattered + errors.emitted_sky * glow_of_sky) / sky : 0.0};
  }

  /// Neighbouring channels have skies of much the same shape: of some, the one is looked at that has most
  /// light.
  void skies() {
    std::vector<std::size_t> order(channels_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto wavelength = [&](std::size_t c) { return channels_[c].points.points.front().wavelength_um; };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return wavelength(a) < wavelength(b); });
    const std::size_t groups = std::min(order.size(), kSkiesLookedAt);
    parallel_for(static_cast<std::int64_t>(groups), question_.threads, [&](std::int64_t k) {
      const std::size_t group = static_cast<std::size_t>(k);
      const auto first = order.begin() + static_cast<std::ptrdiff_t>(group * order.size() / groups),
                 last = order.begin() + static_cast<std::ptrdiff_t>((group + 1) * order.size() / groups);
      const auto light = [&](std::size_t c) {
        return mean(channels_[c].points.share, channels_[c].sky_irradiance());
      };
      const double error = sky(
          *std::max_element(first, last, [&](std::size_t a, std::size_t b) { return light(a) < light(b); }));
      for (auto c = first; c != last; ++c) errors_[*c].sky.sky = error;
    });
  }

  /// Of the whole sky of a channel: sunlight as at the point where most of it comes down, and the air's own
  /// light.
  double sky(std::size_t channel) const {
    const ChannelLights& given = channels_[channel];
    const SkyDirections finer = halved(question_.directions);
    const std::size_t azimuths = finer.azimuth_rad.size();
    std::vector<double> radiance(finer.zenith_rad.size() * azimuths, 0.0);
    double beam = 0.0, beyond_at_sun = 0.0;  // what the table has more at the Sun than the finer one
    if (given.emitted) {
      const ChannelEmission emitted = given.emission(question_.column, question_.geometry, finer);
      for (std::size_t d = 0; d < radiance.size(); ++d)
        radiance[d] += mean(given.points.share, emitted.sky[d / azimuths]);
    }
    if (given.scattering && given.scattering->sunlit()) {
      const ChannelPoints& points = given.points;
      std::size_t middle = 0;
      const auto light = [&](std::size_t p) { return points.share[p] * given.scattered.sky_irradiance[p]; };
      for (std::size_t p = 1; p < points.size(); ++p)
        if (light(p) > light(middle)) middle = p;
      beam = points.sun[middle];
      const double ground_km = question_.column.levels().altitude_km.front();
      const ColumnSolution solved = ColumnSolver(question_.scattering)
                                        .solve(question_.column.levels(), points.points[middle].layers(),
                                               *question_.geometry.sun_zenith_rad);
      const double sun = *question_.geometry.sun_zenith_rad;
      const SunCell cell = finer.sun_cell(sun);
      for (std::size_t z = 0; z < finer.zenith_rad.size(); ++z) {
        const std::vector<double> ring =
            sky_ring(solved.sunlit(), -std::cos(finer.zenith_rad[z]), finer.azimuth_rad, ground_km, cell);
        for (std::size_t a = 0; a < azimuths; ++a)
          radiance[z * azimuths + a] += points.irradiance[middle] * std::max(0.0, ring[a]);
      }
      constexpr double kTowards[] = {0.0};
      const auto at_sun = [&](const SunCell& own) {
        return sky_ring(solved.sunlit(), -std::cos(sun), kTowards, ground_km, own)[0];
      };
      if (cell.any())
        beyond_at_sun =
            points.irradiance[middle] * (at_sun(question_.directions.sun_cell(sun)) - at_sun(cell));
    }
    return inclined_error(question_.directions, radiance, beam,
                          question_.geometry.sun_zenith_rad.value_or(0.0), beyond_at_sun);
  }

  const ErrorQuestion& question_;
  std::span<const std::vector<ChannelBin>> bins_;
  std::span<const ChannelLights> channels_;
  std::vector<AtmosphereErrors> errors_;
};

}  // namespace

std::vector<AtmosphereErrors> estimate_errors(const ErrorQuestion& question,
                                              std::span<const std::vector<ChannelBin>> bins,
                                              std::span<const ChannelLights> channels) {
  return Estimate(question, bins, channels).made();
}

}  // namespace ifov::atmosphere
