#pragma once

#include <algorithm>

#include "math/angle.h"

namespace ifov::atmosphere {

/// How far light may be off by RoundEarthLight under a low Sun, relative, as measured with haze: of paths up to 80 degrees from the
/// nadir, and of the sky (docs/theory/atmosphere_round_earth.md). 0 where the Sun is 10 degrees above the horizon and more.
struct RoundEarthError {
  double path = 0.0, sky = 0.0;
};

inline RoundEarthError round_earth_error(double sun_zenith_rad) {
  constexpr double kLow_deg = 80.0, kPath = 0.0008, kSky = 0.0014;  // by degree
  const double lower = std::max(0.0, sun_zenith_rad / math::kDegree - kLow_deg);
  return {kPath * lower, kSky * lower};
}

}  // namespace ifov::atmosphere
