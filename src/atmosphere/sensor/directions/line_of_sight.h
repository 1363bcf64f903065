#pragma once

#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

/// A line of sight from a surface to the sensor.
struct LineOfSight {
  double zenith_rad = 0.0;                ///< of the direction from the surface towards the sensor
  double azimuth_rad = 0.0;               ///< of that direction from the Sun's
  double height_km = 0.0;                 ///< of the surface above the column's ground
  double sensor_km = kTopOfAtmosphereKm;  ///< altitude of the sensor above mean sea level
};

}  // namespace ifov::atmosphere
