// The part of SensorAtmosphere that has several lines of sight.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "atmosphere/sensor/channel_lights.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {

SensorAtmosphere::LightAlongLine SensorAtmosphere::line_of_sight(std::size_t line) const {
  if (lines_of_sight_.trivial()) return {view_transmittance_, view_radiance_, diffuse_transmittance_};
  return {row(line_of_sight_transmittance_, line), row(line_of_sight_radiance_, line),
          row(line_of_sight_diffuse_, line)};
}

void SensorAtmosphere::add_lines_of_sight(std::size_t channel, const ChannelLights& lights) {
  const std::size_t first = nodes_.first_node(channel), count = nodes_.first_node(channel + 1) - first;
  const auto store = [&](std::vector<double>& rows, std::size_t k) {
    return std::span(rows).subspan(k * node_count() + first, count);
  };
  const auto add = [&](const std::vector<double>& at_points, std::vector<double>& rows, std::size_t k) {
    add_source(channel, at_points, rows.data() + k * node_count());
  };
  for (std::size_t s = 0; s < lines_of_sight_.known_lines(); ++s) {
    nodes_.average_seen(channel, lights.points.line_of_sight_view[s], store(line_of_sight_transmittance_, s));
    if (lights.scattering) {
      add(lights.scattered.line_of_sight_path[s], line_of_sight_radiance_, s);
      nodes_.average_seen(channel, lights.scattered.line_of_sight_diffuse[s],
                          store(line_of_sight_diffuse_, s));
    }
    if (lights.emitted) add(lights.emitted->line_of_sight_path[s], line_of_sight_radiance_, s);
  }
  for (std::size_t h = 0; h < lines_of_sight_.height().known().size(); ++h) {
    add(h == 0 ? lights.points.sun : lights.points.sun_at_height[h - 1], sun_at_height_, h);
    if (lights.scattering)
      add(h == 0 ? lights.scattered.sky_irradiance : lights.scattered.sky_at_height[h - 1], sky_at_height_,
          h);
    if (lights.emitted)
      add(h == 0 ? lights.emitted->sky_irradiance : lights.emitted->sky_at_height[h - 1], sky_at_height_, h);
  }
}

/// The level is the last of the geometry's heights.
void SensorAtmosphere::add_fluxes(std::size_t channel, const ChannelLights& lights) {
  const std::size_t first = nodes_.first_node(channel), count = nodes_.first_node(channel + 1) - first;
  LevelFluxes& to = level_fluxes_;
  add_source(channel, lights.points.sun_at_height.back(), to.sun.data());
  if (lights.scattering) {
    add_source(channel, lights.scattered.sky_at_height.back(), to.down.data());
    add_source(channel, lights.scattered.level_up, to.up.data());
    nodes_.average_seen(channel, lights.scattered.ground_up, std::span(to.ground_up).subspan(first, count));
    nodes_.average_seen(channel, lights.scattered.ground_down,
                        std::span(to.ground_down).subspan(first, count));
    const auto mean = [&](const std::vector<double>& at_points) {
      return std::inner_product(at_points.begin(), at_points.end(), lights.points.share.begin(), 0.0);
    };
    channel_means_.diffuse_transmittance[channel] = mean(lights.scattered.diffuse_transmittance);
    channel_means_.spherical_albedo[channel] = mean(lights.scattered.spherical_albedo);
  }
  if (lights.emitted) {
    add_source(channel, lights.emitted->sky_at_height.back(), to.down.data());
    add_source(channel, lights.emitted->level_up, to.up.data());
  }
}

/// At lines of sight between those of the table, from nodes and by interpolation against all points as they
/// are there.
AtmosphereError SensorAtmosphere::line_of_sight_error(std::size_t channel, const ChannelLights& lights,
                                                      const radiometry::Spectrum& ground) const {
  constexpr double kGrey = 0.3, kGrey_k = 300.0;
  AtmosphereError error;
  if (lines_of_sight_.trivial()) return error;
  const double sine = geometry_.sun_sine();
  const ChannelPoints& points = lights.points;
  const std::vector<double> sky = lights.sky_irradiance();
  // What a grey surface sends, and the part of it that is reflected.
  const auto reflected = [&](double sun, double all_sky) {
    return kGrey * (sun * sine + all_sky) / std::numbers::pi;
  };
  const auto sent = [&](double wavelength_um, double light) {
    return light + (1.0 - kGrey) * radiometry::planck_w_m2_sr_um(wavelength_um, kGrey_k);
  };
  const std::vector<LineOfSight> checks = lines_of_sight_.checks(geometry_.sun_zenith_rad);
  for (std::size_t k = 0; k < checks.size(); ++k) {
    const std::size_t s = lines_of_sight_.known_lines() + k;
    double surface = 0.0, path = 0.0, groundlit = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double wavelength_um = points.points[p].wavelength_um, light = reflected(points.sun[p], sky[p]);
      surface += points.share[p] * points.line_of_sight_view[s][p] * sent(wavelength_um, light);
      if (lights.emitted) path += points.share[p] * lights.emitted->line_of_sight_path[s][p];
      if (!lights.scattering) continue;
      path += points.share[p] * lights.scattered.line_of_sight_path[s][p];
      groundlit += points.share[p] * lights.scattered.line_of_sight_diffuse[s][p] * light *
                   ground.at(wavelength_um) / kGrey;
    }
    const std::vector<double> weight = lines_of_sight_.weights(checks[k]);
    double surface_given = 0.0, path_given = 0.0, groundlit_given = 0.0;
    std::vector<double> planck(node_count());
    nodes_.planck(kGrey_k, std::span<double>(planck));
    for (std::size_t n = nodes_.first_node(channel); n < nodes_.first_node(channel + 1); ++n) {
      const double light = reflected(sun_[n], sky_irradiance_[n]), share = nodes_.node_weight(n);
      for (std::size_t line = 0; line < weight.size(); ++line) {
        if (weight[line] == 0.0) continue;
        const double part = share * weight[line];
        surface_given += part * line_of_sight(line).transmittance[n] * (light + (1.0 - kGrey) * planck[n]);
        path_given += part * line_of_sight(line).radiance[n];
        groundlit_given += part * line_of_sight(line).diffuse_transmittance[n] * light *
                           ground.at(nodes_.node_wavelength_um(n)) / kGrey;
      }
    }
    if (surface > 0.0)
      error.surface = std::max(error.surface, std::min(1.0, std::abs(surface_given / surface - 1.0)));
    error.path = std::max(error.path, std::abs(path_given - path) + std::abs(groundlit_given - groundlit));
  }
  return error;
}

}  // namespace ifov::atmosphere
