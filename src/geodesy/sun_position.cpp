#include "geodesy/sun_position.h"

#include <cmath>
#include <numbers>

#include "geodesy/observer.h"

namespace ifov::geodesy {

SunPosition sun_position(UtcTime time, double latitude_rad, double longitude_rad, double height_m,
                         double ut1_minus_utc_s) {
  const Observer observer(time, latitude_rad, longitude_rad, height_m, ut1_minus_utc_s, "Sun");
  const math::Vec3 to_sun = observer.enu_au(apparent_sun_au(observer.tt1(), observer.tt2()));
  SunPosition sun;
  sun.distance_au = math::length(to_sun);
  sun.direction_enu = math::normalized(to_sun);
  const Horizontal angles = horizontal(sun.direction_enu);
  sun.azimuth_rad = angles.azimuth_rad;
  sun.elevation_rad = angles.elevation_rad;
  return sun;
}

double refraction_rad(double elevation_rad, double pressure_hpa, double temperature_c) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  // The Sun's radius and refraction at the horizon: below this nothing of the disc is seen.
  constexpr double kLowest_deg = -(0.26667 + 0.5667);
  const double elevation_deg = elevation_rad / kDegree;
  if (elevation_deg < kLowest_deg) return 0.0;
  const double bend_deg = pressure_hpa / 1010.0 * 283.0 / (273.0 + temperature_c) * 1.02 /
                          (60.0 * std::tan((elevation_deg + 10.3 / (elevation_deg + 5.11)) * kDegree));
  return bend_deg * kDegree;
}

math::Vec3 direction_enu(double azimuth_rad, double elevation_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::sin(azimuth_rad), level * std::cos(azimuth_rad), std::sin(elevation_rad)};
}

}  // namespace ifov::geodesy
