#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// How far apart, m, the rays through the pixel's left and right side (image x), and its upper and lower one (image y), meet the plane
/// that touches the surface where the ray through the pixel's middle meets it. Of a scanner the rays of either line are sent at their
/// own times, so that y is the way of the platform. Not numbers where a ray meets nothing, or runs past that plane.
extern const Collector kGsd;

}  // namespace ifov::truth
