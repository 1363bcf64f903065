#pragma once

#include <span>

#include "atmosphere/sensor/directions/sky_directions.h"

namespace ifov::atmosphere {

/// Changes a sky's radiances at the directions of a table, [zenith][azimuth], so that the one that is linear between them has
/// the integral over each cell that the smooth one through them has. A parabola of second derivative c lies below its chord
/// by c h^2 / 12 in the mean of a step h: each value moves by the mean of what its two steps lack, along either angle. Where
/// second derivatives change sign, as beside the Sun, and in the last steps to the zenith and the horizon nothing moves, and no
/// value by more than a quarter.
void keep_integrals(const SkyDirections& directions, std::span<double> radiance);

}  // namespace ifov::atmosphere
