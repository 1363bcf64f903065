#include "geodesy/sun_position.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::geodesy {
namespace {

/// The Sun as seen from the Earth's centre in the celestial frame (GCRS), au: light time and aberration
/// applied.
void apparent_sun_au(double tt1, double tt2, double sun_au[3]) {
  // TDB differs from TT by less than 2 ms, in which the Earth moves 60 m.
  double heliocentric[2][3], barycentric[2][3];
  eraEpv00(tt1, tt2, heliocentric, barycentric);
  // The Sun moves about the barycentre at 15 m/s: where it was when its light left.
  double sun_velocity[3], distance, direction[3];
  eraPmp(barycentric[1], heliocentric[1], sun_velocity);
  eraSxp(-1.0, heliocentric[0], sun_au);
  const double light_days = eraPm(sun_au) * ERFA_AULT / ERFA_DAYSEC;
  for (int i = 0; i < 3; ++i) sun_au[i] -= light_days * sun_velocity[i];
  eraPn(sun_au, &distance, direction);

  double velocity[3];  // of the Earth, in units of the speed of light
  eraSxp(ERFA_AULT / ERFA_DAYSEC, barycentric[1], velocity);
  const double inverse_gamma = std::sqrt(1.0 - eraPdp(velocity, velocity));
  double seen[3];
  eraAb(direction, velocity, distance, inverse_gamma, seen);
  eraSxp(distance, seen, sun_au);
}

}  // namespace

SunPosition sun_position(UtcTime time, double latitude_rad, double longitude_rad, double height_m,
                         double ut1_minus_utc_s) {
  if (!(std::abs(latitude_rad) <= 0.5 * std::numbers::pi))
    throw InputError(
        format("a latitude of {:g} degrees is beyond the poles", latitude_rad * 180.0 / std::numbers::pi));
  double tai1, tai2, tt1, tt2, ut11, ut12;
  // 1 is a warning: leap seconds for that year are not known.
  if (eraUtctai(time.jd1, time.jd2, &tai1, &tai2) < 0 ||
      eraUtcut1(time.jd1, time.jd2, ut1_minus_utc_s, &ut11, &ut12) < 0)
    throw InputError(format("the Sun cannot be placed at {}", format_utc(time)));
  eraTaitt(tai1, tai2, &tt1, &tt2);

  double sun_au[3], itrs_from_gcrs[3][3], sun_itrs[3], place_m[3];
  apparent_sun_au(tt1, tt2, sun_au);
  eraC2t06a(tt1, tt2, ut11, ut12, 0.0, 0.0, itrs_from_gcrs);
  eraRxp(itrs_from_gcrs, sun_au, sun_itrs);
  if (eraGd2gc(ERFA_WGS84, longitude_rad, latitude_rad, height_m, place_m) != 0)
    throw InputError(format("a height of {:g} m is no place on Earth", height_m));
  const math::Vec3 to_sun{sun_itrs[0] - place_m[0] / ERFA_DAU, sun_itrs[1] - place_m[1] / ERFA_DAU,
                          sun_itrs[2] - place_m[2] / ERFA_DAU};

  const double sin_lat = std::sin(latitude_rad), cos_lat = std::cos(latitude_rad);
  const double sin_lon = std::sin(longitude_rad), cos_lon = std::cos(longitude_rad);
  const math::Vec3 east{-sin_lon, cos_lon, 0.0};
  const math::Vec3 north{-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat};
  const math::Vec3 up{cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};

  SunPosition sun;
  sun.distance_au = math::length(to_sun);
  sun.direction_enu =
      math::normalized({math::dot(to_sun, east), math::dot(to_sun, north), math::dot(to_sun, up)});
  sun.azimuth_rad = std::atan2(sun.direction_enu.x, sun.direction_enu.y);
  if (sun.azimuth_rad < 0.0) sun.azimuth_rad += 2.0 * std::numbers::pi;
  sun.elevation_rad = std::atan2(sun.direction_enu.z, std::hypot(sun.direction_enu.x, sun.direction_enu.y));
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
