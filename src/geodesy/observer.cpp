#include "geodesy/observer.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::geodesy {

Observer::Observer(UtcTime time, double latitude_rad, double longitude_rad, double height_m,
                   double ut1_minus_utc_s, const char* body) {
  if (!(std::abs(latitude_rad) <= 0.5 * std::numbers::pi))
    throw InputError(
        format("a latitude of {:g} degrees is beyond the poles", latitude_rad * 180.0 / std::numbers::pi));
  double tai1, tai2, ut11, ut12;
  // 1 is a warning: leap seconds for that year are not known.
  if (eraUtctai(time.jd1, time.jd2, &tai1, &tai2) < 0 ||
      eraUtcut1(time.jd1, time.jd2, ut1_minus_utc_s, &ut11, &ut12) < 0)
    throw InputError(format("the {} cannot be placed at {}", body, format_utc(time)));
  eraTaitt(tai1, tai2, &tt1_, &tt2_);
  eraC2t06a(tt1_, tt2_, ut11, ut12, 0.0, 0.0, itrs_from_gcrs_);
  double place_m[3];
  if (eraGd2gc(ERFA_WGS84, longitude_rad, latitude_rad, height_m, place_m) != 0)
    throw InputError(format("a height of {:g} m is no place on Earth", height_m));
  place_au_ = {place_m[0] / ERFA_DAU, place_m[1] / ERFA_DAU, place_m[2] / ERFA_DAU};

  const double sin_lat = std::sin(latitude_rad), cos_lat = std::cos(latitude_rad);
  const double sin_lon = std::sin(longitude_rad), cos_lon = std::cos(longitude_rad);
  east_ = {-sin_lon, cos_lon, 0.0};
  north_ = {-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat};
  up_ = {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
}

math::Vec3 Observer::enu_au(math::Vec3 body_gcrs_au) const {
  const auto row = [&](int i) {
    return itrs_from_gcrs_[i][0] * body_gcrs_au.x + itrs_from_gcrs_[i][1] * body_gcrs_au.y +
           itrs_from_gcrs_[i][2] * body_gcrs_au.z;
  };
  const math::Vec3 to_body{row(0) - place_au_.x, row(1) - place_au_.y, row(2) - place_au_.z};
  return {math::dot(to_body, east_), math::dot(to_body, north_), math::dot(to_body, up_)};
}

Horizontal horizontal(math::Vec3 enu) {
  Horizontal result;
  result.azimuth_rad = std::atan2(enu.x, enu.y);
  if (result.azimuth_rad < 0.0) result.azimuth_rad += 2.0 * std::numbers::pi;
  result.elevation_rad = std::atan2(enu.z, std::hypot(enu.x, enu.y));
  return result;
}

math::Vec3 apparent_sun_au(double tt1, double tt2) {
  // TDB differs from TT by less than 2 ms, in which the Earth moves 60 m.
  double heliocentric[2][3], barycentric[2][3];
  eraEpv00(tt1, tt2, heliocentric, barycentric);
  // The Sun moves about the barycentre at 15 m/s: where it was when its light left.
  double sun_au[3], sun_velocity[3], distance, direction[3];
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
  return {distance * seen[0], distance * seen[1], distance * seen[2]};
}

math::Vec3 apparent_moon_au(double tt1, double tt2) {
  double moon[2][3];
  eraMoon98(tt1, tt2, moon);
  const double light_days = eraPm(moon[0]) * ERFA_AULT / ERFA_DAYSEC;
  return {moon[0][0] - light_days * moon[1][0], moon[0][1] - light_days * moon[1][1],
          moon[0][2] - light_days * moon[1][2]};
}

}  // namespace ifov::geodesy
