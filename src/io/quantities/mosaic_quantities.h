#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// What a detector under a mosaic of filters has: each element's own channel, as one band; how far that may be off; and by channel,
/// not a number where an element sees another.
extern const Quantity kMosaic, kMosaicHalfWidth, kMosaicChannels;

}  // namespace ifov::io::quantities
