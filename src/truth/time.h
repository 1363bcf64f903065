#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// When the ray through the pixel's middle was sent, seconds after the document's instant; also where it meets nothing.
extern const Collector kTime;

}  // namespace ifov::truth
