#pragma once

#include <string>
#include <vector>

#include "atmosphere/survey/sky_view.h"

namespace ifov::atmosphere {

/// Where the sky's light is unpolarized, on the circle through the Sun and the zenith: between a point of
/// Babinet above the Sun and one of Brewster below it, and below the point of Arago above the point opposite
/// the Sun, light scattered more than once outweighs what is scattered once (Coulson 1988, Polarization and
/// Intensity of Light in the Atmosphere).
struct NeutralPoint {
  std::string name;           ///< Babinet, Brewster, Arago
  double zenith_rad = 0.0;    ///< less than 0 on the side away from the Sun
  double distance_rad = 0.0;  ///< from the Sun; of Arago's from the point opposite
};

/// From the horizon below the Sun over the zenith to the one opposite. `sky` is sunlit; between its
/// directions Q is taken for linear, so a point is right to a tenth of their distance (0.2 degrees).
std::vector<NeutralPoint> neutral_points(const SkyView& sky, double sun_zenith_rad);

}  // namespace ifov::atmosphere
