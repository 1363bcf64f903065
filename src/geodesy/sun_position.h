#pragma once

#include "geodesy/geodetic.h"
#include "geodesy/utc_time.h"

namespace ifov::geodesy {

/// The Sun's centre as seen from a place: topocentric (parallax and aberration included), without refraction.
struct SunPosition {
  double azimuth_rad = 0.0;    ///< clockwise from north, [0, 2 pi)
  double elevation_rad = 0.0;  ///< above the plane normal to the ellipsoid, geometric
  double distance_au = 1.0;
  EnuVector direction_enu;  ///< unit, from the place towards the Sun
};

/// `ut1_minus_utc_s`: 0 where not known costs at most 0.9 s of time, 13.5 arc seconds.
/// IAU 2006/2000A precession-nutation and the Earth ephemeris of Bretagnon and Simon as ERFA has them (about
/// 0.01 arc seconds 1900-2100). Throws InputError for latitudes beyond the poles or years that ERFA refuses.
SunPosition sun_position(UtcTime time, const Geodetic& place, double ut1_minus_utc_s = 0.0);

/// What refraction adds to a geometric elevation, radians (Saemundsson's formula as in Reda and Andreas 2004,
/// eq. 42); 0 where the refracted Sun is below the horizon by more than its radius.
double refraction_rad(double elevation_rad, double pressure_hpa, double temperature_c);

/// Degrees as of a compass, [0, 360), of an azimuth of any sign.
double compass_deg(double azimuth_rad);

/// The unit vector of an azimuth (clockwise from north) and an elevation.
EnuVector direction_enu(double azimuth_rad, double elevation_rad);

}  // namespace ifov::geodesy
