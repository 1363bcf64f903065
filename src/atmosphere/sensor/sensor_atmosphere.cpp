#include "atmosphere/sensor/sensor_atmosphere.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/column/light_limits.h"
#include "atmosphere/sensor/channel_lights.h"
#include "atmosphere/sensor/error_estimate.h"
#include "atmosphere/sensor/model_error.h"
#include "atmosphere/sensor/model_error_table.h"
#include "core/parallel.h"
#include "radiometry/channel_grid.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

/// Light darker than this share of what a white surface sends into space may err by as much as that would.
constexpr double kLeastOfWhite = 3e-4;

/// Radiance above the air of a white surface of 300 K in the Sun.
double white_above(double wavelength_um, double irradiance) {
  return irradiance / std::numbers::pi + radiometry::planck_w_m2_sr_um(wavelength_um, 300.0);
}

}  // namespace

SensorAtmosphere::SensorAtmosphere(const AtmosphereColumn& column, const Inputs& inputs)
    : geometry_(inputs.geometry),
      directions_(inputs.sky.value_or(SkyDirections::standard(inputs.geometry.sun_zenith_rad))),
      lines_of_sight_(inputs.lines_of_sight.value_or(LineOfSightGrid(geometry_.own_sight()))) {
  geometry_.spherical_earth = inputs.scattering.spherical_earth;
  if (inputs.polarized && !inputs.scattering.polarized)
    throw std::invalid_argument("polarized tables of the air need the polarized solver");
  if (!lines_of_sight_.trivial()) {
    geometry_.lines_of_sight = lines_of_sight_.lines();
    const std::vector<LineOfSight> checks = lines_of_sight_.checks(geometry_.sun_zenith_rad);
    geometry_.lines_of_sight.insert(geometry_.lines_of_sight.end(), checks.begin(), checks.end());
    geometry_.heights_km.assign(lines_of_sight_.height().known().begin() + 1,
                                lines_of_sight_.height().known().end());
  }
  if (geometry_.level_fluxes)
    geometry_.heights_km.push_back(
        std::min(geometry_.sensor_altitude_km, column.levels().altitude_km.back()) -
        column.levels().altitude_km.front());
  std::vector<std::vector<ChannelBin>> bins;
  for (const radiometry::Channel& channel : inputs.channels)
    bins.push_back(channel_bins(channel, inputs.solar_irradiance, column.gas_terms()));
  const BinOptics optics(column, bins, inputs.threads);
  std::vector<ChannelLights> channels;
  for (const std::vector<ChannelBin>& channel : bins)
    channels.push_back({{column, channel, optics, geometry_}});
  std::optional<FinerAtmosphere> finer;
  if (inputs.with_errors) finer.emplace(column);
  enum class Kind { scattering, emission, check };
  struct Task {
    ChannelLights* lights;
    std::size_t solution;
    Kind kind;
  };
  std::vector<Task> tasks;
  for (ChannelLights& lights : channels) {
    const ChannelPoints::Point &shortest = lights.points.points.front(),
                               &longest = lights.points.points.back();
    if (!(geometry_.sun_zenith_rad && shortest.wavelength_um <= kLastSolar_um) &&
        longest.wavelength_um < kFirstThermal_um)
      continue;
    lights.scattering.emplace(column, lights.points, geometry_, directions_, inputs.scattering,
                              inputs.polarized, inputs.directional.get());
    for (std::size_t k = 0; k < lights.scattering->solutions(); ++k)
      tasks.push_back({&lights, k, Kind::scattering});
    if (longest.wavelength_um >= kFirstThermal_um) {
      lights.ask_for_own_scattering(column, inputs.scattering);
      for (std::size_t k = 0; lights.own_scattering && k < lights.own_scattering->solutions(); ++k)
        tasks.push_back({&lights, k, Kind::emission});
    }
    if (!finer) continue;
    lights.checks.emplace(*lights.scattering, lights.points, geometry_, *finer,
                          lights.own_scattering.has_value());
    for (std::size_t k = 0; k < lights.checks->solutions(); ++k) tasks.push_back({&lights, k, Kind::check});
  }
  const ColumnSolver solver(inputs.scattering), careful(FinerAtmosphere::finer(inputs.scattering));
  std::mutex telling;
  std::size_t solved = 0;
  parallel_for(static_cast<std::int64_t>(tasks.size()), inputs.threads, [&](std::int64_t k) {
    const Task task = tasks[static_cast<std::size_t>(k)];
    switch (task.kind) {
      case Kind::scattering: task.lights->scattering->solve(solver, task.solution, inputs.kept); break;
      case Kind::emission: task.lights->own_scattering->solve(task.solution); break;
      case Kind::check: task.lights->checks->solve(careful, task.solution, inputs.kept); break;
    }
    if (!inputs.progress) return;
    const std::scoped_lock lock(telling);
    inputs.progress(++solved, tasks.size());
  });
  parallel_for(static_cast<std::int64_t>(channels.size()), inputs.threads, [&](std::int64_t k) {
    ChannelLights& lights = channels[static_cast<std::size_t>(k)];
    if (lights.scattering) lights.scattered = lights.scattering->at_points();
    if (lights.points.points.back().wavelength_um >= kFirstThermal_um)
      lights.emitted.emplace(lights.emission(column, geometry_, directions_));
  });

  build_nodes(inputs, channels);
  const std::size_t nodes = node_count(), zeniths = directions_.zenith_rad.size();
  for (auto* row : {&view_radiance_, &diffuse_transmittance_, &spherical_albedo_, &sky_irradiance_})
    row->assign(nodes, 0.0);
  if (!lines_of_sight_.trivial()) {
    for (auto* rows : {&line_of_sight_transmittance_, &line_of_sight_radiance_, &line_of_sight_diffuse_})
      rows->assign(lines_of_sight_.known_lines() * nodes, 0.0);
    for (auto* rows : {&sun_at_height_, &sky_at_height_})
      rows->assign(lines_of_sight_.height().known().size() * nodes, 0.0);
  }
  if (geometry_.level_fluxes)
    for (auto* row : {&channel_means_.diffuse_transmittance, &channel_means_.spherical_albedo})
      row->assign(channels.size(), 0.0);
  if (geometry_.level_fluxes)
    for (auto* row : {&level_fluxes_.sun, &level_fluxes_.down, &level_fluxes_.up, &level_fluxes_.ground_up,
                      &level_fluxes_.ground_down})
      row->assign(nodes, 0.0);
  sky_.assign(zeniths * directions_.azimuth_rad.size() * nodes, 0.0);
  groundlit_.assign(zeniths * nodes, 0.0);
  if (inputs.polarized) {
    Polarization& all = polarization_.emplace();
    for (auto* rows : {&all.sky_q, &all.sky_u}) rows->assign(sky_.size(), 0.0);
    all.groundlit_q.assign(groundlit_.size(), 0.0);
    for (auto* rows : {&all.path_q, &all.path_u, &all.diffuse_q})
      rows->assign(lines_of_sight_.known_lines() * nodes, 0.0);
  }
  if (inputs.directional) make_room_for_directional(*inputs.directional, inputs.polarized);
  parallel_for(static_cast<std::int64_t>(channels.size()), inputs.threads, [&](std::int64_t k) {
    const std::size_t channel = static_cast<std::size_t>(k);
    if (directional_ && channels[channel].scattering) add_directional(channel, channels[channel]);
    if (channels[channel].scattering) add_scattering(channel, channels[channel]);
    if (channels[channel].emitted) add_emission(channel, channels[channel]);
    if (geometry_.level_fluxes) add_fluxes(channel, channels[channel]);
    if (!lines_of_sight_.trivial()) add_lines_of_sight(channel, channels[channel]);
    if (polarization_ && channels[channel].scattering) add_polarization(channel, channels[channel]);
  });
  normalise_sky();
  if (directional_) couple_directional();
  if (polarization_) bound_polarization();
  if (!finer) return;
  const SensorGeometry alone = geometry_.alone();
  std::vector<radiometry::Spectrum> grounds;
  for (std::size_t c = 0; c < channels.size(); ++c) grounds.push_back(ground_in_errors(c, inputs.ground));
  errors_ = estimate_errors(
      {column, *finer, alone, directions_, inputs.scattering, grounds, inputs.threads, inputs.kept}, bins,
      channels);
  for (std::size_t c = 0; c < errors_.size(); ++c) {
    errors_[c].nodes.surface = nodes_.worst_error(c);
    errors_[c].model = channel_model_error(column, bins[c], optics, alone, ModelErrorTable::built_in());
    errors_[c].lines_of_sight = line_of_sight_error(c, channels[c], grounds[c]);
  }
}

void SensorAtmosphere::build_nodes(const Inputs& inputs, const std::vector<ChannelLights>& channels) {
  const double sine = geometry_.sun_sine();
  std::vector<radiometry::ChannelGrid> grids;
  for (const ChannelLights& lights : channels) {
    const ChannelPoints& points = lights.points;
    std::vector<double> wavelengths, ground, sky = lights.sky_irradiance();
    double white = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      wavelengths.push_back(points.points[p].wavelength_um);
      ground.push_back(sine * points.sun[p] + sky[p]);
      white += points.share[p] * white_above(wavelengths[p], points.irradiance[p]);
    }
    // Through clouds surfaces are seen by scattered light, if at all.
    std::vector<double> seen = points.view;
    if (points.cloudy() && lights.scattering)
      std::transform(seen.begin(), seen.end(), lights.scattered.diffuse_transmittance.begin(), seen.begin(),
                     std::plus<>());
    grids.emplace_back(std::move(wavelengths), points.share, std::move(ground), std::move(sky),
                       std::move(seen), kLeastOfWhite * white);
  }
  nodes_ = radiometry::SpectralNodes::build(grids, inputs.surfaces, inputs.demands);
  sun_.assign(node_count(), 0.0);
  view_transmittance_.assign(node_count(), 0.0);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::size_t first = nodes_.first_node(c), count = nodes_.first_node(c + 1) - first;
    nodes_.average_source(c, channels[c].points.sun, std::span(sun_).subspan(first, count));
    nodes_.average_seen(c, channels[c].points.view, std::span(view_transmittance_).subspan(first, count));
  }
}

void SensorAtmosphere::add_source(std::size_t channel, const std::vector<double>& at_points,
                                  double* row) const {
  const std::size_t first = nodes_.first_node(channel);
  std::vector<double> at_nodes(nodes_.first_node(channel + 1) - first);
  nodes_.average_source(channel, at_points, at_nodes);
  for (std::size_t i = 0; i < at_nodes.size(); ++i) row[first + i] += at_nodes[i];
}

void SensorAtmosphere::add_scattering(std::size_t channel, const ChannelLights& lights) {
  const std::size_t zeniths = directions_.zenith_rad.size(), azimuths = directions_.azimuth_rad.size();
  const std::size_t first = nodes_.first_node(channel), count = nodes_.first_node(channel + 1) - first;
  const ChannelScattering& from = *lights.scattering;
  const ChannelScattering::AtPoints& at = lights.scattered;
  add_source(channel, at.path, view_radiance_.data());
  add_source(channel, at.sky_irradiance, sky_irradiance_.data());
  nodes_.average_seen(channel, at.diffuse_transmittance,
                      std::span(diffuse_transmittance_).subspan(first, count));
  nodes_.average_factor(channel, at.spherical_albedo, std::span(spherical_albedo_).subspan(first, count));
  std::vector<double> part(lights.points.size()), at_nodes(count);
  for (std::size_t s = 0; s < from.solutions(); ++s) {
    std::transform(at.share[s].begin(), at.share[s].end(), at.sky_irradiance.begin(), part.begin(),
                   std::multiplies<>());
    nodes_.average_source(channel, part, at_nodes);
    for (std::size_t d = 0; d < zeniths * azimuths; ++d)
      for (std::size_t i = 0; i < count; ++i)
        sky_[d * node_count() + first + i] += at_nodes[i] * from.sky_shape(s)[d];
    nodes_.average_factor(channel, at.share[s], at_nodes);
    for (std::size_t z = 0; z < zeniths; ++z)
      for (std::size_t i = 0; i < count; ++i)
        groundlit_[z * node_count() + first + i] += at_nodes[i] * from.groundlit_shape(s)[z];
  }
}

void SensorAtmosphere::add_emission(std::size_t channel, const ChannelLights& lights) {
  const std::size_t first = nodes_.first_node(channel), azimuths = directions_.azimuth_rad.size();
  add_source(channel, lights.emitted->path, view_radiance_.data());
  add_source(channel, lights.emitted->sky_irradiance, sky_irradiance_.data());
  std::vector<double> at_nodes(nodes_.first_node(channel + 1) - first);
  for (std::size_t z = 0; z < directions_.zenith_rad.size(); ++z) {
    nodes_.average_source(channel, lights.emitted->sky[z], at_nodes);
    for (std::size_t a = 0; a < azimuths; ++a)
      for (std::size_t i = 0; i < at_nodes.size(); ++i)
        sky_[(z * azimuths + a) * node_count() + first + i] += at_nodes[i];
  }
}

/// The table's own integral is that of the irradiance, and the groundlit sky's the spherical albedo.
void SensorAtmosphere::normalise_sky() {
  const std::vector<double> weights = directions_.level_weights();
  const std::size_t zeniths = directions_.zenith_rad.size(), azimuths = directions_.azimuth_rad.size();
  for (std::size_t n = 0; n < node_count(); ++n) {
    double sky_sum = 0.0, groundlit_sum = 0.0;
    for (std::size_t d = 0; d < weights.size(); ++d) {
      double& sky = sky_[d * node_count() + n];
      sky = std::max(sky, 0.0);
      sky_sum += weights[d] * sky;
      groundlit_sum += weights[d] * std::max(0.0, groundlit_[d / azimuths * node_count() + n]);
    }
    for (std::size_t d = 0; d < weights.size() && sky_sum > 0.0; ++d) {
      const std::size_t at = d * node_count() + n;
      sky_[at] *= sky_irradiance_[n] / sky_sum;
      if (!polarization_) continue;
      polarization_->sky_q[at] *= sky_irradiance_[n] / sky_sum;
      polarization_->sky_u[at] *= sky_irradiance_[n] / sky_sum;
    }
    for (std::size_t z = 0; z < zeniths && groundlit_sum > 0.0; ++z) {
      double& sky = groundlit_[z * node_count() + n];
      sky = std::max(0.0, sky) * std::numbers::pi * spherical_albedo_[n] / groundlit_sum;
      if (polarization_)
        polarization_->groundlit_q[z * node_count() + n] *=
            std::numbers::pi * spherical_albedo_[n] / groundlit_sum;
    }
  }
}

}  // namespace ifov::atmosphere
