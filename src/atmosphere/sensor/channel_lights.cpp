#include "atmosphere/sensor/channel_lights.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace ifov::atmosphere {

void ChannelLights::ask_for_own_scattering(const AtmosphereColumn& column, const ScatteringOptions& options) {
  std::vector<ScatteredEmission::Question> questions;
  for (std::size_t k = 0; k < scattering->solutions(); ++k)
    questions.push_back({scattering->wavelength_um(k), scattering->optics(k)});
  ScatteredEmission asked(column.levels(), std::move(questions), options);
  if (asked.solutions() > 0) own_scattering.emplace(std::move(asked));
}

ChannelEmission ChannelLights::emission(const AtmosphereColumn& column, const SensorGeometry& geometry,
                                        const SkyDirections& directions) const {
  if (!own_scattering) return {column, points, geometry, directions};
  const ChannelEmission::Scattered from{*own_scattering, scattered.emission_share};
  return {column, points, geometry, directions, &from};
}

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
