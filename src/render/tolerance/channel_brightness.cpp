#include "render/tolerance/channel_brightness.h"

#include <algorithm>
#include <cmath>

#include "radiometry/spectral_nodes.h"

namespace ifov::render {

ChannelBrightness::ChannelBrightness(const radiometry::SpectralNodes& nodes) {
  log_radiance_.resize(nodes.channel_count() * (kSteps + 1));
  std::vector<double> at_nodes(nodes.node_count());
  for (int step = 0; step <= kSteps; ++step) {
    nodes.planck(kLowest_k + step, at_nodes);
    for (std::size_t c = 0; c < nodes.channel_count(); ++c) {
      double radiance = 0.0;
      for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
        radiance += nodes.node_weight(n) * at_nodes[n];
      log_radiance_[c * (kSteps + 1) + static_cast<std::size_t>(step)] = std::log(std::max(radiance, 1e-300));
    }
  }
}

double ChannelBrightness::temperature_k(int channel, double radiance_w_m2_sr_um) const {
  const double* table = log_radiance(channel);
  const double target = std::log(std::max(radiance_w_m2_sr_um, 1e-300));
  if (target <= table[0]) return kLowest_k;
  if (target >= table[kSteps]) return kHighest_k;
  const int low = static_cast<int>(std::upper_bound(table, table + kSteps + 1, target) - table) - 1;
  const double t0 = kLowest_k + low, t1 = t0 + 1.0;
  const double span = table[low + 1] - table[low];
  const double share = span > 0.0 ? (target - table[low]) / span : 0.0;
  return 1.0 / (1.0 / t0 + share * (1.0 / t1 - 1.0 / t0));
}

double ChannelBrightness::slope_w_m2_sr_um_k(int channel, double radiance_w_m2_sr_um) const {
  const double temperature = temperature_k(channel, radiance_w_m2_sr_um);
  const double* table = log_radiance(channel);
  const int low = std::clamp(static_cast<int>(temperature - kLowest_k), 0, kSteps - 1);
  const double t0 = kLowest_k + low, t1 = t0 + 1.0;
  const double per_inverse_k = (table[low + 1] - table[low]) / (1.0 / t1 - 1.0 / t0);
  return -radiance_w_m2_sr_um * per_inverse_k / (temperature * temperature);
}

double ChannelBrightness::radiance_w_m2_sr_um(int channel, double temperature_k) const {
  const double* table = log_radiance(channel);
  const double t = std::clamp(temperature_k, kLowest_k, kHighest_k);
  const int low = std::clamp(static_cast<int>(t - kLowest_k), 0, kSteps - 1);
  const double t0 = kLowest_k + low, t1 = t0 + 1.0;
  const double share = (1.0 / t - 1.0 / t0) / (1.0 / t1 - 1.0 / t0);
  return std::exp(table[low] + share * (table[low + 1] - table[low]));
}

}  // namespace ifov::render
