#pragma once

#include <algorithm>

#include "math/angle.h"

namespace ifov::atmosphere {

/// How far light may be off by RoundEarthLight under a low Sun, relative, as measured with haze: of paths up to 80 degrees from the
/// nadir, and of the sky (docs/theory/atmosphere_round_earth.md). 0 where the Sun is 10 degrees above the horizon and more.
struct RoundEarthError {
  double path = 0.0, sky = 0.0;
};

/// `cloudy`: of paths over clouds and skies below them, whose ratio comes of thinner ones.
inline RoundEarthError round_earth_error(double sun_zenith_rad, bool cloudy) {
  constexpr double kLow_deg = 80.0, kPath = 0.0008, kSky = 0.0014;  // by degree
  constexpr double kLastDusk_deg = 95.0, kLastDusk = 0.02;
  const double sun_deg = sun_zenith_rad / math::kDegree;
  const auto risen = [&](double from_deg, double to_deg) {
    return std::clamp((sun_deg - from_deg) / (to_deg - from_deg), 0.0, 1.0);
  };
  const double lower = std::max(0.0, sun_deg - kLow_deg);
  double both = kLastDusk * risen(kLastDusk_deg, kLastDusk_deg + 1.0);
  if (cloudy) both += 0.02 * risen(70.0, 80.0) + 0.04 * risen(89.0, 90.5);
  return {kPath * lower + both, kSky * lower + both};
}

}  // namespace ifov::atmosphere
