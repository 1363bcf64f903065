#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// How warm what the middle of the pixel sees is; not numbers where that is nothing, or has no temperature.
extern const Quantity kTemperature;
/// How warm the surfaces in the pixel are (truth::kPixelTemperature).
extern const Quantity kPixelTemperature;
/// What the surfaces in the pixel gain (truth::kPixelFluxes).
extern const Quantity kFluxes;

}  // namespace ifov::io::quantities
