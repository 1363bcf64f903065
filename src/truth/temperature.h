#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// How warm what the ray through the pixel's middle meets is, K, weighed by area where several materials share it, and the
/// standard deviation of that where it is estimated by rays into the past. Not numbers where that is nothing, or has no temperature.
extern const Collector kTemperature;

}  // namespace ifov::truth
