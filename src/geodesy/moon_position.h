#pragma once

#include "geodesy/geodetic.h"
#include "geodesy/utc_time.h"

namespace ifov::geodesy {

inline constexpr double kMeanMoonDistance_m = 384.4e6;

/// The Moon's centre as seen from a place: topocentric, without refraction.
struct MoonPosition {
  double azimuth_rad = 0.0;    ///< clockwise from north, [0, 2 pi)
  double elevation_rad = 0.0;  ///< above the plane normal to the ellipsoid, geometric
  double distance_m = 0.0;
  EnuVector direction_enu;            ///< unit, from the place towards the Moon
  double phase_angle_rad = 0.0;       ///< at the Moon, between the Sun and the place: 0 is full
  double illuminated_fraction = 0.0;  ///< of the disc
  double sun_distance_au = 1.0;       ///< of the Moon from the Sun
};

/// Arguments and errors as of sun_position(). ERFA's moon98 (Meeus 1998 after ELP 2000-82): rms 3 and at most
/// 19 arc seconds in direction, 32 km in distance, 1950 to 2100.
MoonPosition moon_position(UtcTime time, const Geodetic& place, double ut1_minus_utc_s = 0.0);

/// Irradiance of the Moon across its beam outside the atmosphere, as a fraction of the Sun's at 1 au:
///   10^(-0.4 (V - V_sun)) (384,400 km / distance)^2 / (Sun - Moon distance in au)^2,
///   V = -12.73 + 0.026 |g| + 4e-9 g^4, g the phase angle in degrees (Allen 1976, section 66), V_sun =
///   -26.74.
/// The same at all wavelengths: the Moon is redder than the Sun, which this leaves out, and so it does the
/// surge near full moon.
double moonlight_ratio(const MoonPosition& moon);

}  // namespace ifov::geodesy
