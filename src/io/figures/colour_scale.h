#pragma once

#include "io/envi/colour_map.h"
#include "io/figures/axes.h"

namespace ifov::io {

/// The colour at a share of a map, 0 to 1; beyond these that of the nearer end.
Rgb colour_at(const ColourMap& colours, double share);

/// An upright bar of all colours with the numbers of its axis on the right.
void draw_colour_scale(Canvas& canvas, const ColourMap& colours, const Axis& scale, double x, double y,
                       double height);

}  // namespace ifov::io
