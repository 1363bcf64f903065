#pragma once

#include "radiometry/spectrum.h"

namespace ifov::materials {

/// Imaginary part of the refractive index of ice at 266 K, 0.191 to 160 um (Warren and Brandt 2008; radiometry/refractive_index.h).
const radiometry::Spectrum& ice_extinction_index();

}  // namespace ifov::materials
