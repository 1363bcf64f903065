#include "geodesy/observer.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "geodesy/earth_orientation.h"

namespace ifov::geodesy {
Observer::Times Observer::times(UtcTime time, double ut1_minus_utc_s, const char* body) {
  double tai1, tai2;
  Times times;
  // 1 is a warning: leap seconds for that year are not known.
  if (eraUtctai(time.jd1, time.jd2, &tai1, &tai2) < 0 ||
      eraUtcut1(time.jd1, time.jd2, ut1_minus_utc_s, &times.ut11, &times.ut12) < 0)
    throw InputError(format("the {} cannot be placed at {}", body, format_utc(time)));
  eraTaitt(tai1, tai2, &times.tt1, &times.tt2);
  return times;
}

Observer::Observer(UtcTime time, const Geodetic& place, double ut1_minus_utc_s, const char* body)
    : times_(times(time, ut1_minus_utc_s, body)),
      ecef_from_gcrs_(geodesy::ecef_from_gcrs(time, {ut1_minus_utc_s})),
      ecef_from_enu_(ecef_from_enu(place)) {
  const math::Point3 at_m = ecef_from_enu_.origin().p;
  position_au_ = {{at_m.x / ERFA_DAU, at_m.y / ERFA_DAU, at_m.z / ERFA_DAU}};
}

EnuVector Observer::to_body_au(GcrsVector body_au) const {
  return ecef_from_enu_.inverse()(ecef_from_gcrs_(body_au) - position_au_);
}

Horizontal horizontal(EnuVector vector) {
  Horizontal result;
  result.azimuth_rad = std::atan2(vector.v.x, vector.v.y);
  if (result.azimuth_rad < 0.0) result.azimuth_rad += 2.0 * std::numbers::pi;
  result.elevation_rad = std::atan2(vector.v.z, std::hypot(vector.v.x, vector.v.y));
  return result;
}

GcrsVector apparent_sun_au(double tt1, double tt2) {
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
  return {{distance * seen[0], distance * seen[1], distance * seen[2]}};
}

GcrsVector apparent_moon_au(double tt1, double tt2) {
  double moon[2][3];
  eraMoon98(tt1, tt2, moon);
  const double light_days = eraPm(moon[0]) * ERFA_AULT / ERFA_DAYSEC;
  return {{moon[0][0] - light_days * moon[1][0], moon[0][1] - light_days * moon[1][1],
           moon[0][2] - light_days * moon[1][2]}};
}

}  // namespace ifov::geodesy
