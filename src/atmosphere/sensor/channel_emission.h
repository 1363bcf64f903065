#pragma once

#include <vector>

#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/sky_directions.h"

namespace ifov::atmosphere {

/// What the air of a channel emits, term by term of the band model: without scattering that costs little.
struct ChannelEmission {
  std::vector<double> path;              ///< by point: radiance towards the sensor, W m-2 sr-1 um-1
  std::vector<double> sky_irradiance;    ///< by point: on level ground, W m-2 um-1
  std::vector<std::vector<double>> sky;  ///< [zenith][point]
  /// [line][point] as path, [height][point] as sky_irradiance.
  std::vector<std::vector<double>> line_of_sight_path, sky_at_height;

  ChannelEmission(const AtmosphereColumn& column, const ChannelPoints& points, const SensorGeometry& geometry,
                  const SkyDirections& directions);
};

}  // namespace ifov::atmosphere
