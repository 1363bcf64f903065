#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// Distance, m, from the sensor to what the ray through the pixel's middle meets. Not a number where that is nothing, and of parallel
/// rays, which come from no place.
extern const Collector kRange;

}  // namespace ifov::truth
