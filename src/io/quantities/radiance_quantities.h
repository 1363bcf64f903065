#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// By channel, in the radiance unit.
extern const Quantity kRadiance, kStandardError, kHalfWidth;
/// The part of the half-width that the air's computation adds.
extern const Quantity kAtmosphereHalfWidth;
/// What the model of the air may be off by, in intervals or not.
extern const Quantity kAtmosphereModelError;
/// What it may be off by because temperatures that were solved are what they are.
extern const Quantity kThermalHalfWidth;

}  // namespace ifov::io::quantities
