#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// How warm what the middle of the pixel sees is; not numbers where that is nothing, or has no temperature.
extern const Quantity kTemperature;

}  // namespace ifov::io::quantities
