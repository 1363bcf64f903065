#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// Map coordinates and height of what the middle of the pixel sees; not numbers where that is nothing.
extern const Quantity kLocation;
/// Zenith and azimuth of the direction from there to the sensor.
extern const Quantity kViewAngles;

}  // namespace ifov::io::quantities
