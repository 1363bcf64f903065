#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// Zenith and azimuth (clockwise from north, [0, 360)), degrees, of the direction in which the ray through the pixel's
/// middle came from the sensor, where it met something.
extern const Collector kViewAngles;

}  // namespace ifov::truth
