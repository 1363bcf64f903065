#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// x, y, z in the scene, m, of what the ray through the pixel's middle meets as the sensor's reported pose sends it (Camera::reported).
extern const Collector kLocation;
/// The same of the ray that is true.
extern const Collector kTrueLocation;

}  // namespace ifov::truth
