#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// Where the Sun stands, and under which angle it falls on what the middle of the pixel sees.
extern const Quantity kSunAngles;
/// Whether the Sun is hidden from what the middle of the pixel sees.
extern const Quantity kShadow;
/// How much of the sky it has before it.
extern const Quantity kSkyView;

}  // namespace ifov::io::quantities
