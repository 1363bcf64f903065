#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "materials/material.h"
#include "radiometry/colour/colorimetry.h"

namespace ifov::session {

/// Linear sRGB of a material's reflectance (radiometry/colour), which goes on beyond the ends of its table where that reaches
/// from blue to red. A material that is told outside visible light alone gets the colour of its number.
radiometry::LinearRgb visible_colour(const materials::Material& material, std::size_t number);

/// Colours that are told apart: hues a golden angle from each other.
radiometry::LinearRgb distinct_colour(std::size_t number);

}  // namespace ifov::session
