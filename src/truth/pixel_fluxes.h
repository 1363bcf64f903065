#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// What the surfaces in a pixel's square gain whose temperature is solved, W m-2, of those that its rays meet first: the fluxes of
/// scene::HeatFluxes, mean by area of the square, then the standard error of each; and the share of the square where there is such a
/// surface. Of 16 rays, one in each cell of the square at a random place. Not numbers where no ray meets one.
extern const Collector kPixelFluxes;

}  // namespace ifov::truth
