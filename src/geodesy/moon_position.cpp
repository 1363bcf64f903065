#include "geodesy/moon_position.h"

#include <erfam.h>

#include <cmath>
#include <numbers>

#include "geodesy/observer.h"

namespace ifov::geodesy {

MoonPosition moon_position(UtcTime time, double latitude_rad, double longitude_rad, double height_m,
                           double ut1_minus_utc_s) {
  const Observer observer(time, latitude_rad, longitude_rad, height_m, ut1_minus_utc_s, "Moon");
  const math::Vec3 to_moon = observer.enu_au(apparent_moon_au(observer.tt1(), observer.tt2()));
  const math::Vec3 to_sun = observer.enu_au(apparent_sun_au(observer.tt1(), observer.tt2()));
  MoonPosition moon;
  moon.distance_m = math::length(to_moon) * ERFA_DAU;
  moon.direction_enu = math::normalized(to_moon);
  const Horizontal angles = horizontal(moon.direction_enu);
  moon.azimuth_rad = angles.azimuth_rad;
  moon.elevation_rad = angles.elevation_rad;
  const math::Vec3 moon_to_sun = to_sun - to_moon;
  moon.sun_distance_au = math::length(moon_to_sun);
  const math::Vec3 moon_to_place = -1.0 * to_moon;
  moon.phase_angle_rad = std::atan2(math::length(math::cross(moon_to_sun, moon_to_place)),
                                    math::dot(moon_to_sun, moon_to_place));
  moon.illuminated_fraction = 0.5 * (1.0 + std::cos(moon.phase_angle_rad));
  return moon;
}

double moonlight_ratio(const MoonPosition& moon) {
  constexpr double kSunMagnitude = -26.74, kMeanDistance_m = 384.4e6;
  const double g_deg = moon.phase_angle_rad * 180.0 / std::numbers::pi;
  const double magnitude = -12.73 + 0.026 * g_deg + 4e-9 * std::pow(g_deg, 4);
  const double nearness = kMeanDistance_m / moon.distance_m;
  return std::pow(10.0, -0.4 * (magnitude - kSunMagnitude)) * nearness * nearness /
         (moon.sun_distance_au * moon.sun_distance_au);
}

}  // namespace ifov::geodesy
