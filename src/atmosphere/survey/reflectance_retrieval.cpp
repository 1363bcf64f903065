#include "atmosphere/survey/reflectance_retrieval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atmosphere/sensor/sensor_atmosphere.h"

namespace ifov::atmosphere {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// Emission of ground of 288.15 K over what a white surface reflects, from which on radiance is not of reflected light.
constexpr double kThermal = 1e-3, kGround_k = 288.15;
/// What a white surface must send through the air, over what the air sends itself, for anything to be seen.
constexpr double kSeen = 1e-4;

}  // namespace

ReflectanceRetrieval::ReflectanceRetrieval(const SensorAtmosphere& air) {
  const radiometry::SpectralNodes& nodes = air.nodes();
  const auto sun = air.geometry().sun_zenith_rad;
  std::vector<double> planck(nodes.node_count());
  nodes.planck(kGround_k, planck);
  for (std::size_t c = 0; c < nodes.channel_count(); ++c) {
    first_.push_back(nodes_.size());
    double path = 0.0, white = 0.0, emission = 0.0;
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n) {
      const double weight = nodes.node_weight(n);
      const double down = air.sun_irradiance()[n] * air.geometry().sun_sine() + air.sky_irradiance()[n];
      const double up = air.view_transmittance()[n] + air.diffuse_transmittance()[n];
      nodes_.push_back({weight * air.view_radiance()[n], weight * up * down / std::numbers::pi,
                        std::clamp(air.spherical_albedo()[n], 0.0, 0.99)});
      path += nodes_.back().path;
      white += nodes_.back().lit;
      emission += weight * up * planck[n];
    }
    possible_.push_back(sun && white > kSeen * path && emission < kThermal * white ? 1 : 0);
    if (possible_.back() == 0) left_out_.push_back(c);
  }
  first_.push_back(nodes_.size());
}

std::span<const ReflectanceRetrieval::Node> ReflectanceRetrieval::nodes(std::size_t channel) const {
  return std::span(nodes_).subspan(first_[channel], first_[channel + 1] - first_[channel]);
}

double ReflectanceRetrieval::radiance(std::size_t channel, double reflectance) const {
  double sum = 0.0;
  for (const Node& node : nodes(channel))
    sum += node.path + node.lit * reflectance / (1.0 - node.albedo * reflectance);
  return sum;
}

double ReflectanceRetrieval::slope(std::size_t channel, double reflectance) const {
  double sum = 0.0;
  for (const Node& node : nodes(channel)) {
    const double left = 1.0 - node.albedo * reflectance;
    sum += node.lit / (left * left);
  }
  return sum;
}

/// Radiance rises with reflectance, ever faster, up to 1 / S: Newton's steps end on the root from above.
double ReflectanceRetrieval::reflectance(std::size_t channel, double radiance) const {
  if (!possible(channel) || !std::isfinite(radiance)) return kNone;
  double most = 0.0;
  for (const Node& node : nodes(channel)) most = std::max(most, node.albedo);
  const double end = most > 0.0 ? 1.0 / most : std::numeric_limits<double>::infinity();
  double found = 0.0;
  for (int step = 0; step < 60; ++step) {
    const double next = found + (radiance - this->radiance(channel, found)) / slope(channel, found);
    const double bounded = next < end ? next : 0.5 * (found + end);
    const bool done = std::abs(bounded - found) <= 1e-12 * (1.0 + std::abs(bounded));
    found = bounded;
    if (done) break;
  }
  return found;
}

double ReflectanceRetrieval::half_width(std::size_t channel, double radiance,
                                        double radiance_half_width) const {
  if (!(radiance_half_width >= 0.0)) return kNone;
  const double middle = reflectance(channel, radiance);
  return std::max(reflectance(channel, radiance + radiance_half_width) - middle,
                  middle - reflectance(channel, radiance - radiance_half_width));
}

}  // namespace ifov::atmosphere
