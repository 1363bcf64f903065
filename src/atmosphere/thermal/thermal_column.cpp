#include "atmosphere/thermal/thermal_column.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "atmosphere/linear_source.h"
#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {

ThermalColumn::ThermalColumn(std::span<const double> altitude_km, std::span<const double> planck,
                             std::span<const double> absorption_depth)
    : altitude_km_(altitude_km), planck_(planck), depth_(absorption_depth) {
  if (depth_.empty() || altitude_km.size() != depth_.size() + 1 || planck.size() != depth_.size() + 1) {
    throw std::invalid_argument("a thermal column needs one level more than it has layers");
  }
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    if (!(altitude_km[i + 1] > altitude_km[i])) throw std::invalid_argument("altitudes of levels must rise");
  }
}

ThermalColumn::ThermalColumn(std::span<const double> altitude_km, std::span<const double> planck,
                             std::span<const double> absorption_depth,
                             std::span<const double> scattering_depth)
    : ThermalColumn(altitude_km, planck, absorption_depth) {
  if (scattering_depth.size() != depth_.size())
    throw std::invalid_argument("every layer of a thermal column needs its depth of scattering");
  scattering_ = scattering_depth;
}

double ThermalColumn::source(std::size_t layer, double share, std::span<const double> scattered) const {
  const double planck = planck_[layer] * (1.0 - share) + planck_[layer + 1] * share;
  if (scattering_.empty()) return planck;
  const double all = extinction(layer);
  if (!(all > 0.0)) return 0.0;
  const double sent =
      scattered.empty() ? 0.0 : scattered[2 * layer] * (1.0 - share) + scattered[2 * layer + 1] * share;
  return (depth_[layer] * planck + sent) / all;
}

ThermalRadiance ThermalColumn::radiances(const GaussNodes& nodes, const ThermalGround& ground) const {
  const std::size_t layers = depth_.size(), count = nodes.position.size();
  ThermalRadiance result;
  result.nodes = count;
  result.up.resize((layers + 1) * count);
  result.down.resize((layers + 1) * count);
  result.flux_up.resize(layers + 1);
  result.flux_down.resize(layers + 1);
  std::vector<LinearSource> steps(layers * count);
  for (std::size_t layer = layers; layer-- > 0;) {
    for (std::size_t j = 0; j < count; ++j) {
      const LinearSource step = LinearSource::over(depth_[layer] / nodes.position[j]);
      steps[layer * count + j] = step;
      result.down[layer * count + j] = step.transmission * result.down[(layer + 1) * count + j] +
                                       step.far * planck_[layer + 1] + step.near * planck_[layer];
    }
  }
  const auto flux = [&](const std::vector<double>& radiance, std::size_t level) {
    double sum = 0.0;
    for (std::size_t j = 0; j < count; ++j) {
      sum += nodes.weight[j] * nodes.position[j] * radiance[level * count + j];
    }
    return 2.0 * std::numbers::pi * sum;
  };
  for (std::size_t level = 0; level <= layers; ++level) result.flux_down[level] = flux(result.down, level);

  const double leaving =
      ground.emissivity * ground.planck + (1.0 - ground.emissivity) * result.flux_down[0] / std::numbers::pi;
  std::fill_n(result.up.begin(), count, leaving);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    for (std::size_t j = 0; j < count; ++j) {
      const LinearSource& step = steps[layer * count + j];
      result.up[(layer + 1) * count + j] = step.transmission * result.up[layer * count + j] +
                                           step.far * planck_[layer] + step.near * planck_[layer + 1];
    }
  }
  for (std::size_t level = 0; level <= layers; ++level) result.flux_up[level] = flux(result.up, level);
  return result;
}

double ThermalColumn::sky(double mu, double observer_km, std::span<const double> scattered) const {
  const double start = std::max(observer_km, altitude_km_.front());
  std::size_t layer =
      static_cast<std::size_t>(std::upper_bound(altitude_km_.begin(), altitude_km_.end(), start) -
                               altitude_km_.begin()) -
      1;
  double radiance = 0.0, transmission = 1.0, walked = 0.0;
  constexpr double kOpaque = 1e-10;  // light that comes through no more counts no longer
  for (double near_share = 0.0; layer < depth_.size() && transmission > kOpaque; ++layer, near_share = 0.0) {
    const double bottom = altitude_km_[layer], top = altitude_km_[layer + 1], height = top - bottom;
    if (start > bottom) near_share = (start - bottom) / height;
    const double length = length_to_shell_km(start, mu, top);
    const LinearSource step = LinearSource::over(extinction(layer) * (length - walked) / height);
    radiance += transmission *
                (step.near * source(layer, near_share, scattered) + step.far * source(layer, 1.0, scattered));
    transmission *= step.transmission;
    walked = length;
  }
  return radiance;
}

ThermalPath ThermalColumn::line_of_sight(double observer_km, double mu, double surface_km,
                                         std::span<const double> scattered) const {
  ThermalPath path;
  const double start = std::max(surface_km, altitude_km_.front()),
               end = std::min(observer_km, altitude_km_.back());
  if (!(end > start)) return path;
  // From the surface up: what arrives is dimmed and added to, layer by layer.
  std::size_t layer =
      static_cast<std::size_t>(std::upper_bound(altitude_km_.begin(), altitude_km_.end(), start) -
                               altitude_km_.begin()) -
      1;
  double z = start, walked = 0.0, optical_depth = 0.0;
  for (; layer < depth_.size() && z < end; ++layer) {
    const double bottom = altitude_km_[layer], height = altitude_km_[layer + 1] - bottom;
    const double next = std::min(end, altitude_km_[layer + 1]), length = length_to_shell_km(start, mu, next);
    const double depth = extinction(layer) * (length - walked) / height;
    const LinearSource step = LinearSource::over(depth);
    path.radiance = step.transmission * path.radiance +
                    step.far * source(layer, (z - bottom) / height, scattered) +
                    step.near * source(layer, (next - bottom) / height, scattered);
    optical_depth += depth;
    walked = length;
    z = next;
  }
  path.transmittance = std::exp(-optical_depth);
  return path;
}

ThermalPath ThermalColumn::path(double observer_km, double mu, double length_km) const {
  ThermalPath path;
  const std::size_t layers = depth_.size();
  double z = observer_km;
  if (z > altitude_km_.back()) {
    if (mu <= 0.0) return path;
    length_km -= (z - altitude_km_.back()) / mu;
    z = altitude_km_.back();
  }
  z = std::max(z, altitude_km_.front());
  if (length_km <= 0.0) return path;
  // The layer that the path enters first.
  const auto above = mu > 0.0 ? std::lower_bound(altitude_km_.begin(), altitude_km_.end(), z)
                              : std::upper_bound(altitude_km_.begin(), altitude_km_.end(), z);
  std::ptrdiff_t layer = above - altitude_km_.begin() - 1;
  if (mu == 0.0) layer = std::clamp<std::ptrdiff_t>(layer, 0, static_cast<std::ptrdiff_t>(layers) - 1);
  const double slope = std::abs(mu);
  double optical_depth = 0.0;
  while (layer >= 0 && layer < static_cast<std::ptrdiff_t>(layers)) {
    const double bottom = altitude_km_[layer], top = altitude_km_[layer + 1], height = top - bottom;
    const double available = mu > 0.0 ? z - bottom : mu < 0.0 ? top - z : 0.0;
    const bool ends = mu == 0.0 || length_km * slope <= available;
    const double crossed = ends ? length_km : available / slope;
    const double rise = mu == 0.0 ? 0.0 : ends ? length_km * slope : available;
    const double next = mu > 0.0 ? z - rise : z + rise;
    const double depth = depth_[layer] > 0.0 ? depth_[layer] * crossed / height : 0.0;
    const auto planck_at = [&](double altitude) {
      const double share = (altitude - bottom) / height;
      return planck_[layer] * (1.0 - share) + planck_[layer + 1] * share;
    };
    const LinearSource step = LinearSource::over(depth);
    path.radiance += std::exp(-optical_depth) * (step.near * planck_at(z) + step.far * planck_at(next));
    optical_depth += depth;
    if (ends) break;
    length_km -= crossed;
    z = next;
    layer += mu > 0.0 ? -1 : 1;
  }
  path.transmittance = std::exp(-optical_depth);
  return path;
}

}  // namespace ifov::atmosphere
