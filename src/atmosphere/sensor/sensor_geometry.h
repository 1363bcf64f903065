#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "atmosphere/sensor/directions/line_of_sight.h"

namespace ifov::atmosphere {

/// Where Sun and sensor stand.
struct SensorGeometry {
  /// Of the Sun at the ground; none: night.
  std::optional<double> sun_zenith_rad;
  /// From the ground towards the sensor.
  double view_zenith_rad = 0.0;
  /// Of that direction from the Sun's, either way round: the air is the same on both sides of the Sun's plane,
  /// but for the sign of U.
  double view_azimuth_rad = 0.0;
  /// Above mean sea level; at or above the top of the air it is the same everywhere.
  double sensor_altitude_km = 100.0;
  /// Further lines of sight that are wanted, each with its own sensor's altitude, and further heights of surfaces above
  /// the ground.
  std::vector<LineOfSight> lines_of_sight = {};
  std::vector<double> heights_km = {};
  bool level_fluxes = false;    ///< light through the level at the sensor's altitude is wanted, up and down
  bool spherical_earth = true;  ///< of sunlight, as ScatteringOptions of the same inputs have it

  /// The Sun for a solution of which only what comes from the ground is wanted.
  double any_sun_zenith_rad() const { return sun_zenith_rad.value_or(0.7); }
  /// Of sunlight across the beam, what falls on level ground; 0 by night and of a Sun below the horizon.
  double sun_sine() const { return sun_zenith_rad ? std::max(0.0, std::cos(*sun_zenith_rad)) : 0.0; }
  /// The sensor's own line of sight, from the ground.
  LineOfSight own_sight() const { return {view_zenith_rad, view_azimuth_rad, 0.0, sensor_altitude_km}; }
  /// The same without these.
  SensorGeometry alone() const {
    SensorGeometry geometry = *this;
    geometry.lines_of_sight.clear();
    geometry.heights_km.clear();
    geometry.level_fluxes = false;
    return geometry;
  }
};

}  // namespace ifov::atmosphere
