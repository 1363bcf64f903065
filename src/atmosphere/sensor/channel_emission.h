#pragma once

#include <vector>

#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/directions/sky_directions.h"

namespace ifov::atmosphere {

class ScatteredEmission;

/// What the air of a channel emits, term by term of the band model: what it scatters of that comes from solutions beside, all
/// else costs little. Over black and cold ground.
struct ChannelEmission {
  std::vector<double> path;              ///< by point: radiance towards the sensor, W m-2 sr-1 um-1
  std::vector<double> sky_irradiance;    ///< by point: on level ground, W m-2 um-1
  std::vector<std::vector<double>> sky;  ///< [zenith][point]
  /// [line][point] as path, [height][point] as sky_irradiance.
  std::vector<std::vector<double>> line_of_sight_path, sky_at_height;
  std::vector<double> level_up;  ///< by point: up through the sensor's level, where the geometry wants it

  /// Solutions, all solved, with their shares, [solution][point].
  struct Scattered {
    const ScatteredEmission& solutions;
    const std::vector<std::vector<double>>& share;
  };
  /// `scattered`: null where the air scatters nothing of its light.
  ChannelEmission(const AtmosphereColumn& column, const ChannelPoints& points, const SensorGeometry& geometry,
                  const SkyDirections& directions, const Scattered* scattered = nullptr);
};

}  // namespace ifov::atmosphere
