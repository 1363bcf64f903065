#include "geodesy/sun_position.h"

#include <cmath>
#include <numbers>

#include "geodesy/observer.h"
#include "math/angle.h"

namespace ifov::geodesy {

SunPosition sun_position(UtcTime time, const Geodetic& place, double ut1_minus_utc_s) {
  const Observer observer(time, place, ut1_minus_utc_s, "Sun");
  const EnuVector to_sun = observer.to_body_au(apparent_sun_au(observer.tt1(), observer.tt2()));
  SunPosition sun;
  sun.distance_au = length(to_sun);
  sun.direction_enu = normalized(to_sun);
  const Horizontal angles = horizontal(sun.direction_enu);
  sun.azimuth_rad = angles.azimuth_rad;
  sun.elevation_rad = angles.elevation_rad;
  return sun;
}

double refraction_rad(double elevation_rad, double pressure_hpa, double temperature_c) {
  // The Sun's radius and refraction at the horizon: below this nothing of the disc is seen.
  constexpr double kLowest_deg = -(0.26667 + 0.5667);
  const double elevation_deg = elevation_rad / math::kDegree;
  if (elevation_deg < kLowest_deg) return 0.0;
  const double bend_deg = pressure_hpa / 1010.0 * 283.0 / (273.0 + temperature_c) * 1.02 /
                          (60.0 * std::tan((elevation_deg + 10.3 / (elevation_deg + 5.11)) * math::kDegree));
  return bend_deg * math::kDegree;
}

double compass_deg(double azimuth_rad) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const double degrees = std::fmod(azimuth_rad * kDegrees, 360.0);
  if (degrees >= 0.0) return degrees;
  return degrees + 360.0 < 360.0 ? degrees + 360.0 : 0.0;
}

EnuVector direction_enu(double azimuth_rad, double elevation_rad) {
  const double level = std::cos(elevation_rad);
  return {{level * std::sin(azimuth_rad), level * std::cos(azimuth_rad), std::sin(elevation_rad)}};
}

}  // namespace ifov::geodesy
