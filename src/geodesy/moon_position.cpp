#include "geodesy/moon_position.h"

#include <erfam.h>

#include <cmath>
#include <numbers>

#include "geodesy/observer.h"

namespace ifov::geodesy {

MoonPosition moon_position(UtcTime time, const Geodetic& place, double ut1_minus_utc_s) {
  const Observer observer(time, place, ut1_minus_utc_s, "Moon");
  const EnuVector to_moon = observer.to_body_au(apparent_moon_au(observer.tt1(), observer.tt2()));
  const EnuVector to_sun = observer.to_body_au(apparent_sun_au(observer.tt1(), observer.tt2()));
  MoonPosition moon;
  moon.distance_m = length(to_moon) * ERFA_DAU;
  moon.direction_enu = normalized(to_moon);
  const Horizontal angles = horizontal(moon.direction_enu);
  moon.azimuth_rad = angles.azimuth_rad;
  moon.elevation_rad = angles.elevation_rad;
  const EnuVector moon_to_sun = to_sun - to_moon;
  moon.sun_distance_au = length(moon_to_sun);
  const EnuVector moon_to_observer = -1.0 * to_moon;
  moon.phase_angle_rad =
      std::atan2(length(cross(moon_to_sun, moon_to_observer)), dot(moon_to_sun, moon_to_observer));
  moon.illuminated_fraction = 0.5 * (1.0 + std::cos(moon.phase_angle_rad));
  return moon;
}

double moonlight_ratio(const MoonPosition& moon) {
  constexpr double kSunMagnitude = -26.74;
  const double g_deg = moon.phase_angle_rad * 180.0 / std::numbers::pi;
  const double magnitude = -12.73 + 0.026 * g_deg + 4e-9 * std::pow(g_deg, 4);
  const double nearness = kMeanMoonDistance_m / moon.distance_m;
  return std::pow(10.0, -0.4 * (magnitude - kSunMagnitude)) * nearness * nearness /
         (moon.sun_distance_au * moon.sun_distance_au);
}

}  // namespace ifov::geodesy
