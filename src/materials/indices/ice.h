#pragma once

#include "radiometry/spectrum.h"

namespace ifov::materials {

/// Every measured value, however small: radiometry::refractive_index("ice") leaves out what reflectance does not need, and light
/// in snow is absorbed by k of 1e-11 to 1e-3. Imaginary part of the refractive index of ice at 266 K, 0.191 to 160 um (Warren and Brandt 2008; data/indices/ice.txt).
const radiometry::Spectrum& ice_extinction_index();

}  // namespace ifov::materials
