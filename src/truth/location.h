#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// x, y, z in the scene, m, of what the ray through the pixel's middle meets.
extern const Collector kLocation;

}  // namespace ifov::truth
