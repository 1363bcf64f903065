#pragma once

#include <algorithm>

#include "math/angle.h"

namespace ifov::atmosphere {

/// How far light may be off by RoundEarthLight under a low Sun, relative, as measured with haze: of paths up to 80 degrees from the
/// nadir, and of the sky (docs/theory/atmosphere_round_earth.md). 0 where the Sun is 20 degrees above the horizon and more.
struct RoundEarthError {
  double path = 0.0, sky = 0.0;
};

/// What stands between the Sun and the air that it lights.
struct RoundEarthAir {
  bool cloudy = false;  ///< ratios come of thinner clouds
  double molecules =
      1.0;  ///< vertical scattering depth: where there is little, light at dusk is what grazes haze and clouds
  double haze = 0.0;  ///< that of aerosol
};

inline RoundEarthError round_earth_error(double sun_zenith_rad, const RoundEarthAir& air) {
  constexpr double kLow_deg = 80.0, kPath = 0.0008, kSky = 0.0014;  // by degree
  constexpr double kLastDusk_deg = 95.0, kLastDusk = 0.02, kBright = 0.05;
  const double sun_deg = sun_zenith_rad / math::kDegree;
  const auto risen = [&](double from_deg, double to_deg) {
    return std::clamp((sun_deg - from_deg) / (to_deg - from_deg), 0.0, 1.0);
  };
  const double lower = std::max(0.0, sun_deg - kLow_deg);
  double both = kLastDusk * risen(kLastDusk_deg, kLastDusk_deg + 1.0);
  const double dark = std::clamp(1.0 - air.molecules / kBright, 0.0, 1.0);
  // Within a degree of sunset light in haze and clouds falls to a tenth.
  const double sunset = risen(89.0, 90.0) * (1.0 - risen(90.5, 91.0));
  // Single directions, in which clouds at dusk are off by more than fluxes are, and thick haze at dusk towards the Sun.
  double of_path = 0.0, of_sky = 0.0;
  if (air.cloudy) {
    of_path = (0.03 + 0.07 * dark) * risen(75.0, 80.0) + dark * (0.1 * sunset + 0.15 * risen(92.0, 94.0)) +
              (1.0 - dark) * (0.07 * risen(88.0, 89.0) + 0.6 * risen(92.0, 94.0));
    of_sky = dark * (0.03 * risen(86.0, 89.0) + 0.05 * risen(88.0, 89.0) + 0.65 * risen(89.0, 90.0) +
                     0.8 * risen(90.0, 92.0) - 1.2 * risen(92.0, 94.0));
    // The Sun's side of the horizon, where clouds that molecules do not outshine, or thin ones, let light through.
    constexpr double kThin = 0.3, kThick = 3.0, kOutshone = 0.2;
    const double thin = std::clamp((kThick - air.haze) / (kThick - kThin), 0.0, 1.0),
                 seen = std::max(thin, 1.0 - air.molecules / kOutshone);
    of_sky += (1.0 - dark) * seen * std::min(1.0, air.haze / kThin) *
              (0.18 * risen(87.5, 89.0) + 0.05 * risen(89.5, 90.25) - 0.1 * risen(90.5, 91.5) +
               0.04 * risen(92.0, 94.0));
  } else {
    const double thick = std::min(1.0, air.haze) * (1.0 - risen(91.0, 92.0));
    of_path = thick * (0.004 * risen(74.0, 82.0) + 0.04 * risen(87.0, 89.0));
    of_sky = thick * (0.01 * risen(74.0, 82.0) + 0.03 * risen(84.0, 89.0));
  }
  if (air.cloudy)
    both += 0.02 * risen(70.0, 80.0) + 0.05 * risen(89.0, 90.0) + 0.2 * risen(92.0, 94.0) +
            dark * 0.25 * risen(90.5, 91.0);
  else
    both += 0.2 * dark * std::min(1.0, air.haze) * sunset;
  return {kPath * lower + both + of_path, kSky * lower + both + of_sky};
}

/// How far the glow of clouds high above the ground may be off that flat layers scatter, relative, towards a slanted line of sight and
/// of the sky: by photons 1.9 % of it at 78 degrees over cirrus at 4 um, where the crystals scatter 0.7 of what they take.
/// `scattered`: that share, of what clouds that high take of all that clouds do.
inline RoundEarthError glow_error(double view_zenith_rad, double scattered) {
  constexpr double kSteep_deg = 60.0, kSlanted_deg = 75.0, kPath = 0.03, kSky = 0.01;
  const double slant =
      std::clamp((view_zenith_rad / math::kDegree - kSteep_deg) / (kSlanted_deg - kSteep_deg), 0.0, 1.0);
  return {kPath * slant * scattered, kSky * scattered};
}

}  // namespace ifov::atmosphere
