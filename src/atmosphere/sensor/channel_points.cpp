#include "atmosphere/sensor/channel_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "atmosphere/spherical_shells.h"
#include "math/angle.h"

namespace ifov::atmosphere {
namespace {

/// Length of the sunbeam within each layer over the layer's thickness, on a spherical Earth or in flat layers.
std::vector<double> sun_slants(const std::vector<double>& altitude_km, double zenith_rad, bool spherical) {
  const double ground = altitude_km.front(), mu = std::cos(zenith_rad);
  if (!spherical) return std::vector<double>(altitude_km.size() - 1, 1.0 / mu);
  std::vector<double> slants;
  for (std::size_t i = 0; i + 1 < altitude_km.size(); ++i)
    slants.push_back((length_to_shell_km(ground, mu, altitude_km[i + 1]) -
                      length_to_shell_km(ground, mu, altitude_km[i])) /
                     (altitude_km[i + 1] - altitude_km[i]));
  return slants;
}

/// A lower Sun counts as this one in what scattered light is told relative to: where gas absorbs, their own beams are dark by
/// hundreds of powers of ten, between which nothing is interpolated.
constexpr double kLowSun_rad = 80.0 * math::kDegree;

/// Of the sunbeam, only above a height.
std::vector<double> above(const std::vector<double>& altitude_km, std::vector<double> slants,
                          double height_km) {
  const double surface_km = altitude_km.front() + height_km;
  for (std::size_t i = 0; i < slants.size(); ++i)
    slants[i] *=
        std::clamp((altitude_km[i + 1] - surface_km) / (altitude_km[i + 1] - altitude_km[i]), 0.0, 1.0);
  return slants;
}

}  // namespace

std::vector<double> view_slants(const std::vector<double>& altitude_km, const LineOfSight& line,
                                bool spherical) {
  const double surface_km = altitude_km.front() + line.height_km, mu = std::cos(line.zenith_rad);
  std::vector<double> slants;
  for (std::size_t i = 0; i + 1 < altitude_km.size(); ++i) {
    const double low = std::clamp(surface_km, altitude_km[i], altitude_km[i + 1]),
                 high = std::clamp(line.sensor_km, low, altitude_km[i + 1]);
    const double length =
        spherical ? length_to_shell_km(surface_km, mu, high) - length_to_shell_km(surface_km, mu, low)
                  : (high - low) / mu;
    slants.push_back(length / (altitude_km[i + 1] - altitude_km[i]));
  }
  return slants;
}

ChannelPoints::Beams ChannelPoints::base_of(const LayerOptics& layers) const {
  std::vector<double> depths;
  for (std::size_t i = 0; i < layers.layers(); ++i) {
    double depth = layers.gas_absorption[i] + layers.rayleigh_scattering[i] + layers.aerosol_scattering[i] +
                   layers.aerosol_absorption[i];
    if (!layers.cloud_scattering.empty()) depth -= layers.cloud_scattering[i] + layers.cloud_absorption[i];
    depths.push_back(std::max(0.0, depth));
  }
  const auto through = [&](const std::vector<double>& slants) {
    return std::exp(-std::inner_product(slants.begin(), slants.end(), depths.begin(), 0.0));
  };
  Beams beams{{through(sun_slants_)}, {through(view_slants_)}, {}, {}};
  for (const std::vector<double>& slants : line_slants_)
    beams.line_of_sight_view.push_back({through(slants)});
  for (const std::vector<double>& slants : height_slants_) beams.sun_at_height.push_back({through(slants)});
  beams.sun_at_sensor = {through(sensor_slants_)};
  for (const std::vector<double>& slants : line_end_slants_)
    beams.sun_at_line_end.push_back({through(slants)});
  return beams;
}

ChannelPoints::ChannelPoints(const AtmosphereColumn& column, const std::vector<ChannelBin>& bins,
                             const BinOptics& optics, const SensorGeometry& geometry) {
  const std::vector<double>& altitude_km = column.levels().altitude_km;
  const std::vector<double> up = view_slants(altitude_km, geometry.own_sight(), geometry.spherical_earth);
  const double sun_rad = geometry.sun_zenith_rad.value_or(0.0);
  const bool below = sun_rad >= 0.5 * std::numbers::pi, low = sun_rad > kLowSun_rad;
  const auto sunbeam = [&](double zenith_rad) {
    return sun_slants(altitude_km, zenith_rad, geometry.spherical_earth);
  };
  const std::vector<double> down = sunbeam(below ? kLowSun_rad : sun_rad);
  std::vector<std::vector<double>> lines_of_sight, suns;
  for (const LineOfSight& line : geometry.lines_of_sight)
    lines_of_sight.push_back(view_slants(altitude_km, line, geometry.spherical_earth));
  for (const double height : geometry.heights_km) suns.push_back(above(altitude_km, down, height));
  if (column.aerosol().cloudy()) cloud_top_km_ = column.aerosol().cloud_top_km();
  if (low || column.aerosol().cloudy()) {
    sun_slants_ = low ? sunbeam(kLowSun_rad) : down;
    view_slants_ = up, line_slants_ = lines_of_sight;
    for (const double height : geometry.heights_km)
      height_slants_.push_back(above(altitude_km, sun_slants_, height));
    const auto at_sensor = [&](double sensor_km) {
      return above(altitude_km, sun_slants_, sensor_km - altitude_km.front());
    };
    sensor_slants_ = at_sensor(geometry.sensor_altitude_km);
    for (const LineOfSight& line : geometry.lines_of_sight)
      line_end_slants_.push_back(at_sensor(line.sensor_km));
    base_.emplace();
    base_->sun_at_line_end.resize(lines_of_sight.size());
    base_->line_of_sight_view.resize(lines_of_sight.size());
    base_->sun_at_height.resize(suns.size());
  }
  line_of_sight_view.resize(lines_of_sight.size());
  sun_at_height.resize(suns.size());
  std::vector<double> depths(altitude_km.size() - 1);
  const auto along = [&](const std::vector<double>& slants) {
    return std::inner_product(slants.begin(), slants.end(), depths.begin(), 0.0);
  };
  for (const ChannelBin& bin : bins) {
    const ColumnOptics& at = optics.at(bin);
    for (std::size_t term = 0; term < at.terms(); ++term) {
      const LayerOptics layers = at.term(term);
      for (std::size_t i = 0; i < layers.layers(); ++i)
        depths[i] = layers.gas_absorption[i] + layers.rayleigh_scattering[i] + layers.aerosol_scattering[i] +
                    layers.aerosol_absorption[i];
      const auto sunlight = [&](const std::vector<double>& slants) {
        return geometry.sun_zenith_rad && !below ? bin.irradiance * std::exp(-along(slants)) : 0.0;
      };
      points.push_back({&at, term, bin.wavelength_um});
      share.push_back(bin.share * at.weight(term));
      irradiance.push_back(bin.irradiance);
      sun.push_back(sunlight(down));
      view.push_back(std::exp(-along(up)));
      for (std::size_t s = 0; s < lines_of_sight.size(); ++s)
        line_of_sight_view[s].push_back(std::exp(-along(lines_of_sight[s])));
      for (std::size_t h = 0; h < suns.size(); ++h) sun_at_height[h].push_back(sunlight(suns[h]));
      if (base_) {
        const Beams beams = base_of(layers);
        const double sunlight_above = geometry.sun_zenith_rad ? bin.irradiance : 0.0;
        base_->sun.push_back(sunlight_above * beams.sun[0]);
        base_->view.push_back(beams.view[0]);
        base_->sun_at_sensor.push_back(sunlight_above * beams.sun_at_sensor[0]);
        for (std::size_t s = 0; s < lines_of_sight.size(); ++s)
          base_->sun_at_line_end[s].push_back(sunlight_above * beams.sun_at_line_end[s][0]);
        for (std::size_t s = 0; s < lines_of_sight.size(); ++s)
          base_->line_of_sight_view[s].push_back(beams.line_of_sight_view[s][0]);
        for (std::size_t h = 0; h < suns.size(); ++h)
          base_->sun_at_height[h].push_back(sunlight_above * beams.sun_at_height[h][0]);
      }
      gas_depth.push_back(std::accumulate(layers.gas_absorption.begin(), layers.gas_absorption.end(), 0.0));
    }
  }
}

}  // namespace ifov::atmosphere
