#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// The normal of what the ray through the pixel's middle meets (normal_seen()): east, north, up. Not numbers where that is nothing.
extern const Collector kNormal;
/// Of the same normal, degrees: the angle between it and the vertical, 0 (level) to 180 (seen from below), and the azimuth, clockwise
/// from north, [0, 360), of the direction in which it leans, which is downhill; that is not a number where the slope is below 1e-6 rad.
extern const Collector kSlope;

}  // namespace ifov::truth
