#pragma once

#include <algorithm>

#include "atmosphere/spherical_shells.h"
#include "math/angle.h"

namespace ifov::atmosphere {

/// Depth of a beam that is level at the bottom of a layer of this vertical depth, from the layer's top.
inline double level_beam_depth(double top_km, double bottom_km, double depth) {
  return depth * half_chord_km(kEarthRadius_km + top_km, kEarthRadius_km + bottom_km) / (top_km - bottom_km);
}

/// Under a Sun near the horizon the depth of its beam goes with the root of how far below a layer's top it is, and where the layer is
/// deep most of what it scatters is scattered just below the top: the layer is cut finely there. 0: cut evenly, to 1.
inline double bend_of_cuts(double top_km, double bottom_km, double depth, double sun_zenith_rad) {
  constexpr double kFirst_rad = 86.0 * math::kDegree, kAll_rad = 89.0 * math::kDegree, kBent = 0.5,
                   kMostBent = 2.0;
  if (sun_zenith_rad <= kFirst_rad) return 0.0;
  const double low = std::min(1.0, (sun_zenith_rad - kFirst_rad) / (kAll_rad - kFirst_rad));
  return low *
         std::clamp((level_beam_depth(top_km, bottom_km, depth) - kBent) / (kMostBent - kBent), 0.0, 1.0);
}

/// Share of the layer above the cut before `part` of `parts`.
inline double place_of_cut(int part, int parts, double bend) {
  const double share = static_cast<double>(part) / parts;
  return share * (1.0 - bend * (1.0 - share));
}

}  // namespace ifov::atmosphere
