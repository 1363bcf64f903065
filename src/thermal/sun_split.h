#pragma once

namespace ifov::thermal {

inline constexpr double kSolarConstant_w_m2 = 1361.0;  ///< at 1 au: Kopp and Lean (2011)

/// Share of the sky in the irradiance of a level plane by the clearness index, global over what would come without air:
/// Erbs, Klein and Duffie (1982), Solar Energy 28, 293, eq. 1.
double diffuse_share(double clearness);

/// Irradiance of the Sun across its beam and of the sky on a level plane, W m-2.
struct SunAndSky {
  double direct_w_m2 = 0.0;
  double diffuse_w_m2 = 0.0;
};
/// From the global irradiance of a level plane, W m-2. Below 3 degrees all of it is the sky's, from 6 degrees on the Sun has its
/// part, which grows between; and the Sun never gives more than it would without air.
SunAndSky split_global(double global_w_m2, double sun_elevation_rad, double sun_distance_au);

}  // namespace ifov::thermal
