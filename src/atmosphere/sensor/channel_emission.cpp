#include "atmosphere/sensor/channel_emission.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "atmosphere/thermal/scattered_emission.h"
#include "atmosphere/thermal/thermal_column.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

/// The column at one point after the other, with what each of its sublayers scatters.
class AirAtPoints {
 public:
  AirAtPoints(const AtmosphereColumn& column, const ChannelEmission::Scattered* scattered)
      : levels_(column.levels()), scattered_(scattered) {
    altitude_km_ = levels_.altitude_km;
    if (scattered_ == nullptr) return;
    const auto altitudes = scattered_->solutions.altitude_km();
    altitude_km_.assign(altitudes.begin(), altitudes.end());
  }

  void go_to(const ChannelPoints::Point& point, std::size_t p) {
    const LayerOptics layers = point.layers();
    std::vector<double> depth = layers.gas_absorption, planck;
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += layers.aerosol_absorption[i];
    for (const double kelvin : levels_.temperature_K)
      planck.push_back(radiometry::planck_w_m2_sr_um(point.wavelength_um, kelvin));
    if (scattered_ == nullptr) {
      depth_ = std::move(depth);
      planck_ = std::move(planck);
      column_.emplace(altitude_km_, planck_, depth_);
      return;
    }
    depth_.clear();
    planck_.clear();
    const std::vector<int>& parts = scattered_->solutions.parts();
    for (std::size_t layer = 0; layer < parts.size(); ++layer)
      for (int part = 0; part < parts[layer]; ++part) {
        const double share = static_cast<double>(part) / parts[layer];
        depth_.push_back(depth[layer] / parts[layer]);
        planck_.push_back(planck[layer] * (1.0 - share) + planck[layer + 1] * share);
      }
    planck_.push_back(planck.back());
    share_.clear();
    for (const std::vector<double>& of_solution : scattered_->share) share_.push_back(of_solution[p]);
    scattering_ = scattered_->solutions.scattering_depth(share_);
    column_.emplace(altitude_km_, planck_, depth_, scattering_);
    mixed_.clear();
  }
  double sky(double mu, double observer_km) { return column_->sky(mu, observer_km, into(-mu)); }
  double line_of_sight(double observer_km, double mu, double surface_km) {
    return column_->line_of_sight(observer_km, mu, surface_km, into(mu)).radiance;
  }

 private:
  /// What is scattered into a direction: lines of one slope end at several heights.
  std::span<const double> into(double mu) {
    if (scattered_ == nullptr) return {};
    const auto [mixed, is_new] = mixed_.try_emplace(mu);
    if (!is_new) return mixed->second;
    auto ring = rings_.find(mu);
    if (ring == rings_.end()) ring = rings_.emplace(mu, scattered_->solutions.ring(mu)).first;
    ScatteredEmission::mix(ring->second, share_, planck_, mixed->second);
    return mixed->second;
  }
  const Levels& levels_;
  const ChannelEmission::Scattered* scattered_;
  std::vector<double> altitude_km_, planck_, depth_, scattering_, share_;
  std::optional<ThermalColumn> column_;
  std::map<double, ScatteredEmission::Ring> rings_;  // by cosine from the zenith of light's way
  std::map<double, std::vector<double>> mixed_;      // the same at this point
};

}  // namespace

ChannelEmission::ChannelEmission(const AtmosphereColumn& column, const ChannelPoints& points,
                                 const SensorGeometry& geometry, const SkyDirections& directions,
                                 const Scattered* scattered)
    : path(points.size()),
      sky_irradiance(points.size()),
      sky(directions.zenith_rad.size(), std::vector<double>(points.size())),
      line_of_sight_path(geometry.lines_of_sight.size(), std::vector<double>(points.size())),
      sky_at_height(geometry.heights_km.size(), std::vector<double>(points.size())) {
  const double ground_km = column.levels().altitude_km.front();
  const GaussNodes hemisphere = gauss_nodes(8);
  AirAtPoints air(column, scattered);
  for (std::size_t p = 0; p < points.size(); ++p) {
    air.go_to(points.points[p], p);
    path[p] = air.line_of_sight(geometry.sensor_altitude_km, std::cos(geometry.view_zenith_rad), ground_km);
    for (std::size_t z = 0; z < sky.size(); ++z)
      sky[z][p] = air.sky(std::cos(directions.zenith_rad[z]), ground_km);
    const auto irradiance = [&](double altitude_km) {
      double sum = 0.0;
      for (std::size_t j = 0; j < hemisphere.position.size(); ++j)
        sum += 2.0 * std::numbers::pi * hemisphere.weight[j] * hemisphere.position[j] *
               air.sky(hemisphere.position[j], altitude_km);
      return sum;
    };
    sky_irradiance[p] = irradiance(ground_km);
    for (std::size_t h = 0; h < sky_at_height.size(); ++h)
      sky_at_height[h][p] = irradiance(ground_km + geometry.heights_km[h]);
    if (geometry.level_fluxes) {
      double up = 0.0;
      for (std::size_t j = 0; j < hemisphere.position.size(); ++j)
        up += 2.0 * std::numbers::pi * hemisphere.weight[j] * hemisphere.position[j] *
              air.line_of_sight(geometry.sensor_altitude_km, hemisphere.position[j], ground_km);
      level_up.push_back(up);
    }
    for (std::size_t s = 0; s < line_of_sight_path.size(); ++s) {
      const LineOfSight& line = geometry.lines_of_sight[s];
      line_of_sight_path[s][p] =
          air.line_of_sight(line.sensor_km, std::cos(line.zenith_rad), ground_km + line.height_km);
    }
  }
}

}  // namespace ifov::atmosphere
