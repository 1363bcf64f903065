#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// Distance from the sensor to what the middle of the pixel sees.
extern const Quantity kRange;
/// Normal of what the middle of the pixel sees; how steep it is and where it faces.
extern const Quantity kNormal, kSlope;
/// How large the pixel is on what its middle sees, along image x and y.
extern const Quantity kGsd;
/// When the middle of the pixel was seen.
extern const Quantity kTime;

}  // namespace ifov::io::quantities
