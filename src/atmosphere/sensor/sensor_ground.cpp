// The part of SensorAtmosphere that has ground which reflects by direction.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "atmosphere/scattering/ground/directional_ground.h"
#include "atmosphere/sensor/channel_lights.h"
#include "atmosphere/sensor/directional_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"

namespace ifov::atmosphere {

void SensorAtmosphere::make_room_for_directional(const DirectionalGround& ground, bool polarized) {
  const std::size_t nodes = node_count();
  directional_ = std::make_shared<DirectionalLight>();
  DirectionalLight& to = *directional_;
  for (auto* row : {&to.lit, &to.of_even, &to.back, &to.albedo, &to.view}) row->assign(nodes, 0.0);
  if (geometry_.level_fluxes)
    for (auto* row : {&to.up, &to.down}) row->assign(nodes, 0.0);
  to.path_i.assign(lines_of_sight_.known_lines() * nodes, 0.0);
  to.sky_i.assign(sky_.size(), 0.0);
  if (polarized) {
    for (auto* rows : {&to.path_q, &to.path_u}) rows->assign(to.path_i.size(), 0.0);
    for (auto* rows : {&to.sky_q, &to.sky_u}) rows->assign(to.sky_i.size(), 0.0);
  }
  to.ground = ground.at(nodes_, polarized);
}

/// As Lambertian ground's light; Q and U as add_polarization() has them.
void SensorAtmosphere::add_directional(std::size_t channel, const ChannelLights& lights) {
  DirectionalLight& to = *directional_;
  const ChannelScattering& from = *lights.scattering;
  const ChannelScattering::AtPoints& at = lights.scattered;
  const std::size_t first = nodes_.first_node(channel), count = nodes_.first_node(channel + 1) - first;
  nodes_.average_factor(channel, at.reflected_albedo, std::span(to.albedo).subspan(first, count));
  nodes_.average_seen(channel, at.reflected_i[0], std::span(to.view).subspan(first, count));
  if (geometry_.level_fluxes) {
    nodes_.average_seen(channel, at.reflected_up, std::span(to.up).subspan(first, count));
    nodes_.average_seen(channel, at.reflected_down, std::span(to.down).subspan(first, count));
  }
  std::vector<double> half(lights.points.size()), along(count), across(count);
  const auto add_stokes = [&](const std::vector<double>& i, const std::vector<double>& q, double sign,
                              double* row) {
    const auto behind = [&](double side, std::vector<double>& nodes) {
      std::transform(i.begin(), i.end(), q.begin(), half.begin(),
                     [side](double whole, double part) { return 0.5 * (whole + side * part); });
      nodes_.average_seen(channel, half, nodes);
    };
    behind(1.0, along);
    behind(-1.0, across);
    for (std::size_t n = 0; n < count; ++n) row[first + n] = sign * (along[n] - across[n]);
  };
  for (std::size_t line = 0; line < lines_of_sight_.known_lines(); ++line) {
    const bool own = lines_of_sight_.trivial();
    const std::size_t k = own ? 0 : line + 1, start = line * node_count();
    nodes_.average_seen(channel, at.reflected_i[k], std::span(to.path_i).subspan(start + first, count));
    if (to.path_q.empty()) continue;
    const double azimuth = own ? geometry_.view_azimuth_rad : geometry_.lines_of_sight[line].azimuth_rad;
    add_stokes(at.reflected_i[k], at.reflected_q[k], 1.0, to.path_q.data() + start);
    add_stokes(at.reflected_i[k], at.reflected_u[k], std::sin(azimuth) < 0.0 ? -1.0 : 1.0,
               to.path_u.data() + start);
  }
  const std::size_t directions = directions_.zenith_rad.size() * directions_.azimuth_rad.size();
  std::vector<double> at_nodes(count);
  for (std::size_t s = 0; s < from.solutions(); ++s) {
    nodes_.average_factor(channel, at.share[s], at_nodes);
    const std::span<const double> shape = from.reflected_shape(s);
    std::vector<double>* const rows[] = {&to.sky_i, &to.sky_q, &to.sky_u};
    for (std::size_t c = 0; c < (to.sky_q.empty() ? 1u : 3u); ++c)
      for (std::size_t d = 0; d < directions; ++d)
        for (std::size_t n = 0; n < count; ++n)
          (*rows[c])[d * node_count() + first + n] += at_nodes[n] * shape[c * directions + d];
  }
}

radiometry::Spectrum SensorAtmosphere::ground_in_errors(std::size_t channel,
                                                        const radiometry::Spectrum& even) const {
  if (!directional_) return even;
  double leaving = 0.0, arriving = 0.0, reflectance = 0.0;
  for (std::size_t n = nodes_.first_node(channel); n < nodes_.first_node(channel + 1); ++n) {
    const double weight = nodes_.node_weight(n), exitance = directional_->exitance(n, 0.0);
    leaving += weight * exitance;
    arriving +=
        weight * (sun_[n] * geometry_.sun_sine() + sky_irradiance_[n] + directional_->albedo[n] * exitance);
    reflectance += weight * even.at(nodes_.node_wavelength_um(n));
  }
  return arriving > 0.0 ? radiometry::Spectrum::constant(std::clamp(leaving / arriving, reflectance, 1.0))
                        : even;
}

void SensorAtmosphere::couple_directional() {
  DirectionalLight& to = *directional_;
  const std::size_t zeniths = directions_.zenith_rad.size(), azimuths = directions_.azimuth_rad.size(),
                    nodes = node_count();
  const std::vector<double> weights = directions_.level_weights();
  const double sine = geometry_.sun_sine();
  std::vector<double> share(nodes), sum(nodes, 0.0);
  for (std::size_t d = 0; d < weights.size(); ++d)
    for (std::size_t n = 0; n < nodes; ++n) sum[n] += weights[d] * std::max(0.0, to.sky_i[d * nodes + n]);
  if (sine > 0.0) {
    to.ground->albedo(sine, share);
    for (std::size_t n = 0; n < nodes; ++n) to.lit[n] = share[n] * sun_[n] * sine;
  }
  for (std::size_t z = 0; z < zeniths; ++z) {
    to.ground->albedo(std::cos(directions_.zenith_rad[z]), share);
    for (std::size_t a = 0; a < azimuths; ++a) {
      const std::size_t d = z * azimuths + a;
      for (std::size_t n = 0; n < nodes; ++n) {
        // As bright as the air's albedo for this light says.
        const double scale = sum[n] > 0.0 ? std::numbers::pi * to.albedo[n] / sum[n] : 0.0;
        double& shape = to.sky_i[d * nodes + n];
        shape = std::max(0.0, shape) * scale;
        if (!to.sky_q.empty()) {
          double &q = to.sky_q[d * nodes + n], &u = to.sky_u[d * nodes + n];
          q *= scale, u *= scale;
          const double polarized = std::hypot(q, u);
          if (polarized > shape) q *= shape / polarized, u *= shape / polarized;
        }
        to.lit[n] += weights[d] * share[n] * sky_[d * nodes + n];
        to.of_even[n] += weights[d] * share[n] * groundlit_[z * nodes + n];
        to.back[n] += weights[d] * share[n] * shape / std::numbers::pi;
      }
    }
  }
}

}  // namespace ifov::atmosphere
