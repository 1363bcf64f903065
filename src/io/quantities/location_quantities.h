#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// Map coordinates and height of what the middle of the pixel sees by the sensor's reported pose; not numbers where that is nothing.
extern const Quantity kLocation;
/// The same by the true pose of the sensor, where that is not the one reported.
extern const Quantity kTrueLocation;
/// Zenith and azimuth of the direction from there to the sensor.
extern const Quantity kViewAngles;

}  // namespace ifov::io::quantities
