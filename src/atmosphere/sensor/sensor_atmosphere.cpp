#include "atmosphere/sensor/sensor_atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/thermal/thermal_column.h"
#include "core/parallel.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

constexpr double kEarthRadius_km = 6371.0;
constexpr double kDegree = std::numbers::pi / 180.0;
/// Air does not glow at shorter wavelengths (below 1e-4 of sunlight), and sunlight that it scatters does not count at
/// longer ones (below 1e-4 of what it emits).
constexpr double kFirstThermal_um = 2.4, kLastSolar_um = 6.0;
/// Light darker than this share of what a white surface sends into space may err by as much as that would.
constexpr double kLeastShare = 3e-4;

/// Length of the sunbeam within each layer over the layer's thickness, on a spherical Earth.
std::vector<double> sun_slants(const std::vector<double>& altitude_km, double zenith_rad) {
  const double ground = kEarthRadius_km + altitude_km.front(), across = ground * std::sin(zenith_rad);
  const auto along = [&](double altitude) {
    const double radius = kEarthRadius_km + altitude;
    return std::sqrt(std::max(0.0, radius * radius - across * across));
  };
  std::vector<double> slants;
  for (std::size_t i = 0; i + 1 < altitude_km.size(); ++i)
    slants.push_back((along(altitude_km[i + 1]) - along(altitude_km[i])) / (altitude_km[i + 1] - altitude_km[i]));
  return slants;
}

/// The same for a straight line of sight in flat layers, up to the sensor.
std::vector<double> view_slants(const std::vector<double>& altitude_km, const SensorGeometry& geometry) {
  std::vector<double> slants;
  for (std::size_t i = 0; i + 1 < altitude_km.size(); ++i) {
    const double crossed = (geometry.sensor_altitude_km - altitude_km[i]) / (altitude_km[i + 1] - altitude_km[i]);
    slants.push_back(std::clamp(crossed, 0.0, 1.0) / std::cos(geometry.view_zenith_rad));
  }
  return slants;
}

/// Radiance above the air of a white surface of 300 K in the Sun.
double white_above(double wavelength_um, double irradiance) {
  return irradiance / std::numbers::pi + radiometry::planck_w_m2_sr_um(wavelength_um, 300.0);
}

double along(const std::vector<double>& slants, const std::vector<double>& depth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < slants.size(); ++i) sum += slants[i] * depth[i];
  return sum;
}

std::vector<double> extinction(const LayerOptics& optics) {
  std::vector<double> sum = optics.gas_absorption;
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] += optics.rayleigh_scattering[i] + optics.aerosol_scattering[i] + optics.aerosol_absorption[i];
  return sum;
}

}  // namespace

SkyDirections SkyDirections::standard() {
  SkyDirections directions;
  for (const double zenith : {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 68.0, 75.0, 80.0, 84.0, 87.0, 89.5})
    directions.zenith_rad.push_back(zenith * kDegree);
  for (int k = 0; k < 19; ++k) directions.azimuth_rad.push_back(10.0 * k * kDegree);
  return directions;
}

/// A channel as its points: bins of the band model, term by term.
struct SensorAtmosphere::ChannelState {
  struct Point {
    const ColumnOptics* optics;
    std::size_t term, bin;
  };
  std::vector<ChannelBin> bins;
  std::vector<Point> points;
  std::vector<double> sun, view, irradiance;  // by point: direct sunlight at the ground, transmittance, sunlight above
  std::size_t first_node = 0, nodes = 0;
};

SensorAtmosphere::SensorAtmosphere(const AtmosphereColumn& column, const Inputs& inputs)
    : geometry_(inputs.geometry), directions_(inputs.sky) {
  std::vector<std::vector<ChannelBin>> bins;
  for (std::size_t c = 0; c < inputs.channels.size(); ++c) {
    bins.push_back(channel_bins(inputs.channels[c], inputs.solar_irradiance));
    if (narrower_than_resolved(inputs.channels[c])) unresolved_.push_back(c);
  }
  const BinOptics optics(column, bins, inputs.threads);
  std::vector<ChannelState> states(inputs.channels.size());
  for (std::size_t c = 0; c < states.size(); ++c) {
    states[c].bins = std::move(bins[c]);
    for (std::size_t b = 0; b < states[c].bins.size(); ++b) {
      const ColumnOptics& at = optics.at(states[c].bins[b].bin);
      for (std::size_t term = 0; term < at.terms(); ++term) states[c].points.push_back({&at, term, b});
    }
  }
  build_nodes(column, inputs, states);
  const std::size_t nodes = node_count(), zeniths = directions_.zenith_rad.size();
  for (auto* row : {&view_radiance_, &diffuse_transmittance_, &spherical_albedo_, &sky_irradiance_})
    row->assign(nodes, 0.0);
  sky_.assign(zeniths * directions_.azimuth_rad.size() * nodes, 0.0);
  groundlit_.assign(zeniths * nodes, 0.0);
  add_scattering(column, states, inputs.threads);
  add_thermal(column, states, inputs.threads);
}

void SensorAtmosphere::build_nodes(const AtmosphereColumn& column, const Inputs& inputs,
                                   std::vector<ChannelState>& states) {
  const std::vector<double>& altitude_km = column.levels().altitude_km;
  const std::vector<double> view_slant = view_slants(altitude_km, geometry_);
  const std::vector<double> sun_slant = sun_slants(altitude_km, geometry_.sun_zenith_rad.value_or(0.0));
  std::vector<std::optional<radiometry::ChannelGrid>> made(states.size());
  parallel_for(static_cast<std::int64_t>(states.size()), inputs.threads, [&](std::int64_t k) {
    ChannelState& state = states[static_cast<std::size_t>(k)];
    std::vector<double> wavelengths, shares;
    for (const ChannelState::Point& point : state.points) {
      const ChannelBin& bin = state.bins[point.bin];
      const std::vector<double> depth = extinction(point.optics->term(point.term));
      const double sun = geometry_.sun_zenith_rad ? bin.irradiance * std::exp(-along(sun_slant, depth)) : 0.0;
      wavelengths.push_back(bin.wavelength_um);
      shares.push_back(bin.share * point.optics->weight(point.term));
      state.sun.push_back(sun);
      state.view.push_back(std::exp(-along(view_slant, depth)));
      state.irradiance.push_back(bin.irradiance);
    }
    double white = 0.0;
    for (std::size_t p = 0; p < shares.size(); ++p) white += shares[p] * white_above(wavelengths[p], state.irradiance[p]);
    made[static_cast<std::size_t>(k)].emplace(std::move(wavelengths), std::move(shares), state.sun, state.view,
                                              kLeastShare * white);
  });
  std::vector<radiometry::ChannelGrid> grids;
  for (auto& grid : made) grids.push_back(std::move(*grid));
  nodes_ = radiometry::SpectralNodes::build(grids, inputs.surfaces, inputs.demands);
  sun_.assign(node_count(), 0.0);
  view_transmittance_.assign(node_count(), 0.0);
  for (std::size_t c = 0; c < states.size(); ++c) {
    ChannelState& state = states[c];
    state.first_node = nodes_.first_node(c);
    state.nodes = nodes_.first_node(c + 1) - state.first_node;
    nodes_.average_source(c, state.sun, std::span(sun_).subspan(state.first_node, state.nodes));
    nodes_.average_factor(c, state.view, std::span(view_transmittance_).subspan(state.first_node, state.nodes));
  }
}

/// Emission follows the band model point by point: it costs little without scattering.
void SensorAtmosphere::add_thermal(const AtmosphereColumn& column, std::vector<ChannelState>& states, int threads) {
  const Levels& levels = column.levels();
  const double mu = std::cos(geometry_.view_zenith_rad);
  const std::size_t zeniths = directions_.zenith_rad.size(), azimuths = directions_.azimuth_rad.size();
  const GaussNodes hemisphere = gauss_nodes(8);
  parallel_for(static_cast<std::int64_t>(states.size()), threads, [&](std::int64_t k) {
    const ChannelState& state = states[static_cast<std::size_t>(k)];
    const std::size_t count = state.points.size();
    if (state.bins.back().wavelength_um < kFirstThermal_um) return;
    std::vector<double> path(count), irradiance(count), planck(levels.altitude_km.size());
    std::vector<std::vector<double>> sky(zeniths, std::vector<double>(count));
    for (std::size_t p = 0; p < count; ++p) {
      const ChannelState::Point& point = state.points[p];
      const LayerOptics optics = point.optics->term(point.term);
      std::vector<double> depth = optics.gas_absorption;
      for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += optics.aerosol_absorption[i];
      for (std::size_t i = 0; i < planck.size(); ++i)
        planck[i] = radiometry::planck_w_m2_sr_um(state.bins[point.bin].wavelength_um, levels.temperature_K[i]);
      const ThermalColumn thermal(levels.altitude_km, planck, depth);
      path[p] = thermal.path(geometry_.sensor_altitude_km, mu).radiance;
      for (std::size_t z = 0; z < zeniths; ++z)
        sky[z][p] = thermal.sky(std::cos(directions_.zenith_rad[z]), levels.altitude_km.front());
      for (std::size_t j = 0; j < hemisphere.position.size(); ++j)
        irradiance[p] += 2.0 * std::numbers::pi * hemisphere.weight[j] * hemisphere.position[j] *
                         thermal.sky(hemisphere.position[j], levels.altitude_km.front());
    }
    std::vector<double> at_nodes(state.nodes);
    const auto add = [&](const std::vector<double>& at_points, double* to) {
      nodes_.average_source(static_cast<std::size_t>(k), at_points, at_nodes);
      for (std::size_t i = 0; i < state.nodes; ++i) to[i] += at_nodes[i];
    };
    add(path, &view_radiance_[state.first_node]);
    add(irradiance, &sky_irradiance_[state.first_node]);
    for (std::size_t z = 0; z < zeniths; ++z)
      for (std::size_t a = 0; a < azimuths; ++a)
        add(sky[z], &sky_[(z * azimuths + a) * node_count() + state.first_node]);
  });
}

/// Scattered light is solved once for each node, with the mean depths of what it stands for, scaled so that sunlight
/// keeps the node's own transmittance on its way down and up.
void SensorAtmosphere::add_scattering(const AtmosphereColumn& column, std::vector<ChannelState>& states, int threads) {
  const Levels& levels = column.levels();
  const std::vector<double> view_slant = view_slants(levels.altitude_km, geometry_);
  const bool sunlit = geometry_.sun_zenith_rad.has_value();
  const double sun_zenith_rad = geometry_.sun_zenith_rad.value_or(0.0);
  const std::vector<double> sun_slant = sun_slants(levels.altitude_km, sun_zenith_rad);
  const double mu = std::cos(geometry_.view_zenith_rad), ground_km = levels.altitude_km.front();
  const std::size_t zeniths = directions_.zenith_rad.size(), azimuths = directions_.azimuth_rad.size();
  const ColumnSolver solver;
  struct Task {
    std::size_t channel, node;
  };
  std::vector<Task> tasks;
  for (std::size_t c = 0; c < states.size(); ++c)
    for (std::size_t i = 0; i < states[c].nodes; ++i) tasks.push_back({c, i});
  parallel_for(static_cast<std::int64_t>(tasks.size()), threads, [&](std::int64_t k) {
    const Task task = tasks[static_cast<std::size_t>(k)];
    const ChannelState& state = states[task.channel];
    const std::size_t node = state.first_node + task.node, count = state.points.size();
    if (!sunlit || nodes_.node_wavelength_um(node) > kLastSolar_um) return;
    std::vector<LayerOptics> optics;
    optics.reserve(count);
    std::vector<double> at_points(count), at_nodes(state.nodes);
    for (const ChannelState::Point& point : state.points) optics.push_back(point.optics->term(point.term));
    const auto mean = [&](auto value) {
      for (std::size_t p = 0; p < count; ++p) at_points[p] = value(optics[p]);
      nodes_.average_factor(task.channel, at_points, at_nodes);
      return at_nodes[task.node];
    };
    LayerOptics here = optics.front();
    for (std::size_t i = 0; i < here.layers(); ++i) {
      here.gas_absorption[i] = mean([&](const LayerOptics& o) { return o.gas_absorption[i]; });
      here.rayleigh_scattering[i] = mean([&](const LayerOptics& o) { return o.rayleigh_scattering[i]; });
      here.aerosol_scattering[i] = mean([&](const LayerOptics& o) { return o.aerosol_scattering[i]; });
      here.aerosol_absorption[i] = mean([&](const LayerOptics& o) { return o.aerosol_absorption[i]; });
      here.aerosol_asymmetry[i] = mean([&](const LayerOptics& o) { return o.aerosol_asymmetry[i]; });
    }
    const auto gas_two_way = [&](const LayerOptics& o) {
      return along(sun_slant, o.gas_absorption) + along(view_slant, o.gas_absorption);
    };
    const double through = mean([&](const LayerOptics& o) { return std::exp(-gas_two_way(o)); });
    const double depth = gas_two_way(here);
    if (depth > 1e-9 && through > 0.0)
      for (double& d : here.gas_absorption) d *= -std::log(std::min(through, 1.0)) / depth;

    const ColumnSolution solution = solver.solve(levels, here, sun_zenith_rad);
    nodes_.average_source(task.channel, state.irradiance, at_nodes);
    const double above = at_nodes[task.node];
    spherical_albedo_[node] = solution.spherical_albedo();
    diffuse_transmittance_[node] = solution.diffuse_transmittance(mu, geometry_.sensor_altitude_km).i;
    view_radiance_[node] +=
        above * solution.sunlit()
                    .path({mu, geometry_.view_azimuth_rad - std::numbers::pi}, geometry_.sensor_altitude_km)
                    .radiance()
                    .i;
    sky_irradiance_[node] += above * solution.sunlit().fluxes().at(ground_km).diffuse_down;
    for (std::size_t z = 0; z < zeniths; ++z) {
      const double down = -std::cos(directions_.zenith_rad[z]);
      groundlit_[z * node_count() + node] = solution.groundlit().path({down, 0.0}, ground_km).radiance().i;
      const SlantSource ring = solution.sunlit().along(down);
      for (std::size_t a = 0; a < azimuths; ++a)
        sky_[(z * azimuths + a) * node_count() + node] +=
            above * std::max(0.0, ring.path(directions_.azimuth_rad[a], ground_km).radiance().i);
    }
  });
}

}  // namespace ifov::atmosphere
