#pragma once

#include "sampling/field.h"
#include "sampling/random.h"

namespace ifov::sampling {

class PixelFootprint;

/// The point of a footprint's distribution about the pixel's centre that a point of the unit square stands for: the first number
/// inverts the marginal in x, the second the share of a narrow strip there. Equal cells of the square become parts of equal weight.
FocalPoint footprint_point(const PixelFootprint& footprint, Point2 u);

}  // namespace ifov::sampling
