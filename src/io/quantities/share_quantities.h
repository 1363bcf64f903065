#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// What share of the pixel's response falls on each material, and the half-width of its interval.
extern const Quantity kAbundance, kAbundanceHalfWidth;

}  // namespace ifov::io::quantities
