#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// Zenith and azimuth (clockwise from north, [0, 360)) of the scene's Sun, or of the Moon where that shines, and the angle between its
/// direction and the normal of what the ray through the pixel's middle meets (normal_seen(); above 90 the side that is seen faces
/// away). Degrees; not numbers where the ray meets nothing, or nothing shines.
extern const Collector kSunAngles;

/// Whether the place that the ray through the pixel's middle meets lies in shadow: 0 where the middle of the Sun's disc is seen from
/// there, 1 where something, or the surface itself, hides it; panes hide it as well. What lets light through, as a leaf does, sees the
/// Sun from either side. Not a number where the ray meets nothing, or nothing shines.
extern const Collector kShadow;

}  // namespace ifov::truth
