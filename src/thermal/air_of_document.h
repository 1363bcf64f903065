#pragma once

#include <optional>
#include <string>
#include <vector>

#include "thermal/sun_split.h"

namespace ifov::thermal {

/// Sunlight under a clear sky by the Sun's height, as shares of what comes above the air across the beam: logarithms are linear between
/// the heights, of direct light in about the air that it crosses, of the sky's in the logarithm of the height's sine. Below the lowest, direct light fades to the horizon and the sky's to 6 degrees below it.
struct ClearSunlight {
  std::vector<double> elevation_rad;  ///< rising, above 0
  std::vector<double> direct;         ///< across the beam
  std::vector<double> diffuse;        ///< on a level plane
  SunAndSky at(double sun_elevation_rad, double sun_distance_au) const;
};

/// Heights of the Sun for which sunlight is solved, degrees from the zenith.
inline constexpr double kSunZeniths_deg[] = {87.0, 83.0, 77.0, 70.0, 60.0, 48.0, 32.0, 0.0};

/// With cloud on a share c of the sky: 1 - 0.75 c^3.4 of the global irradiance is left (Kasten and Czeplak 1980, Solar Energy 24, 177) and
/// 1 - c of the direct; the rest is the sky's.
SunAndSky under_cloud(const SunAndSky& clear, double sun_elevation_rad, double cloud_fraction);

/// What the atmosphere of a document stands in with for what weather does not tell.
struct AirOfDocument {
  /// Long-wave of its clear sky at the ground over that by Prata for its own temperature and vapour there.
  std::optional<double> longwave_over_prata;
  std::optional<ClearSunlight> sunlight;
  std::string clouds;  ///< of its own, in words, where the weather tells none; else empty
};

}  // namespace ifov::thermal
