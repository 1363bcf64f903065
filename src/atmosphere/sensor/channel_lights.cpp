#include "atmosphere/sensor/channel_lights.h"

#include <algorithm>
#include <functional>

namespace ifov::atmosphere {

std::vector<double> ChannelLights::sky_irradiance() const {
  std::vector<double> sum(points.size(), 0.0);
  const auto add = [&](const std::vector<double>& part) {
    std::transform(sum.begin(), sum.end(), part.begin(), sum.begin(), std::plus<>());
  };
  if (scattering) add(scattered.sky_irradiance);
  if (emitted) add(emitted->sky_irradiance);
  return sum;
}

}  // namespace ifov::atmosphere
