// The part of SensorAtmosphere that keeps Q and U.
#include <algorithm>
#include <cmath>
#include <functional>

#include "atmosphere/sensor/channel_lights.h"
#include "atmosphere/sensor/sensor_atmosphere.h"

namespace ifov::atmosphere {
namespace {

/// Makes |(q, u)| at most i.
void bound(double i, double& q, double& u) {
  const double polarized = std::hypot(q, u), most = std::max(0.0, i);
  if (polarized <= most) return;
  q *= most / polarized;
  u *= most / polarized;
}

}  // namespace

StokesVector SensorAtmosphere::sky_stokes(std::size_t zenith, std::size_t azimuth, std::size_t node) const {
  const std::size_t at = (zenith * directions_.azimuth_rad.size() + azimuth) * node_count() + node;
  return {sky_[at], polarization_->sky_q[at], polarization_->sky_u[at], 0.0};
}

StokesVector SensorAtmosphere::groundlit_sky_stokes(std::size_t zenith, std::size_t node) const {
  return {groundlit_sky(zenith, node), polarization_->groundlit_q[zenith * node_count() + node], 0.0, 0.0};
}

SensorAtmosphere::LineOfSightPolarization SensorAtmosphere::line_of_sight_polarization(
    std::size_t line) const {
  return {row(polarization_->path_q, line), row(polarization_->path_u, line),
          row(polarization_->diffuse_q, line)};
}

/// Nodes take light that polarizers along and across an axis let through, as they take any light: their
/// difference is the Stokes parameter.
void SensorAtmosphere::add_polarization(std::size_t channel, const ChannelLights& lights) {
  const ChannelScattering& from = *lights.scattering;
  const ChannelScattering::AtPoints& at = lights.scattered;
  const std::size_t first = nodes_.first_node(channel), count = nodes_.first_node(channel + 1) - first;
  std::vector<double> half(lights.points.size()), along(count), across(count);
  const auto behind = [&](const std::vector<double>& i, const std::vector<double>& q, double sign) -> auto& {
    std::transform(i.begin(), i.end(), q.begin(), half.begin(),
                   [sign](double whole, double part) { return 0.5 * (whole + sign * part); });
    return half;
  };
  const auto difference = [&](double sign, double* row) {
    for (std::size_t n = 0; n < count; ++n) row[first + n] = sign * (along[n] - across[n]);
  };
  const auto add_source = [&](const std::vector<double>& i, const std::vector<double>& q, double sign,
                              double* row) {
    nodes_.average_source(channel, behind(i, q, 1.0), along);
    nodes_.average_source(channel, behind(i, q, -1.0), across);
    difference(sign, row);
  };
  for (std::size_t line = 0; line < lines_of_sight_.known_lines(); ++line) {
    const bool own = lines_of_sight_.trivial();
    const std::size_t k = own ? 0 : line + 1, start = line * node_count();
    const std::vector<double>&path = own ? at.path : at.line_of_sight_path[line],
          &diffuse = own ? at.diffuse_transmittance : at.line_of_sight_diffuse[line];
    const double azimuth = own ? geometry_.view_azimuth_rad : geometry_.lines_of_sight[line].azimuth_rad;
    add_source(path, at.path_q[k], 1.0, polarization_->path_q.data() + start);
    add_source(path, at.path_u[k], std::sin(azimuth) < 0.0 ? -1.0 : 1.0,
               polarization_->path_u.data() + start);
    nodes_.average_seen(channel, behind(diffuse, at.diffuse_q[k], 1.0), along);
    nodes_.average_seen(channel, behind(diffuse, at.diffuse_q[k], -1.0), across);
    difference(1.0, polarization_->diffuse_q.data() + start);
  }
  const std::size_t directions = directions_.zenith_rad.size() * directions_.azimuth_rad.size();
  std::vector<double> part(lights.points.size()), at_nodes(count);
  for (std::size_t s = 0; s < from.solutions(); ++s) {
    const ChannelScattering::SkyPolarization& shape = from.sky_polarization(s);
    std::transform(at.share[s].begin(), at.share[s].end(), at.sky_irradiance.begin(), part.begin(),
                   std::multiplies<>());
    nodes_.average_source(channel, part, at_nodes);
    for (std::size_t d = 0; d < directions; ++d)
      for (std::size_t n = 0; n < count; ++n) {
        polarization_->sky_q[d * node_count() + first + n] += at_nodes[n] * shape.q[d];
        polarization_->sky_u[d * node_count() + first + n] += at_nodes[n] * shape.u[d];
      }
    nodes_.average_factor(channel, at.share[s], at_nodes);
    for (std::size_t z = 0; z < directions_.zenith_rad.size(); ++z)
      for (std::size_t n = 0; n < count; ++n)
        polarization_->groundlit_q[z * node_count() + first + n] += at_nodes[n] * shape.groundlit_q[z];
  }
}

void SensorAtmosphere::bound_polarization() {
  double none = 0.0;
  for (std::size_t k = 0; k < sky_.size(); ++k)
    bound(sky_[k], polarization_->sky_q[k], polarization_->sky_u[k]);
  for (std::size_t k = 0; k < groundlit_.size(); ++k)
    bound(groundlit_[k], polarization_->groundlit_q[k], none);
  for (std::size_t line = 0; line < lines_of_sight_.known_lines(); ++line) {
    const LightAlongLine seen = line_of_sight(line);
    for (std::size_t n = 0; n < node_count(); ++n) {
      const std::size_t k = line * node_count() + n;
      bound(seen.radiance[n], polarization_->path_q[k], polarization_->path_u[k]);
      bound(seen.diffuse_transmittance[n], polarization_->diffuse_q[k], none);
    }
  }
}

}  // namespace ifov::atmosphere
