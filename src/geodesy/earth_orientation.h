#pragma once

#include "geodesy/frames.h"
#include "geodesy/utc_time.h"

namespace ifov::geodesy {

/// Of the Earth among the stars.
inline constexpr double kEarthRotation_rad_s = 7.292115146706979e-5;  // Vallado et al. 2006

/// What the IERS publishes of the Earth's turn. Left at 0: up to 0.9 s, which is 420 m on the equator, and up to 20 m for the pole.
struct EarthOrientation {
  double ut1_minus_utc_s = 0.0;
  double pole_x_rad = 0.0, pole_y_rad = 0.0;  ///< polar motion: towards longitude 0, and 90 degrees west
};

/// Precession and nutation (IAU 2006/2000A), the Earth's rotation and polar motion, without the celestial pole's offsets, which are
/// below a milliarcsecond: 3 cm on the ground. InputError for years that ERFA refuses.
FrameTransform<Ecef, Gcrs> ecef_from_gcrs(UtcTime time, const EarthOrientation& orientation = {});

/// From the frame about the pole of the Earth's rotation and the meridian of Greenwich on its equator, by polar motion.
struct RotatingEquator {};
FrameTransform<Ecef, RotatingEquator> ecef_from_rotating_equator(const EarthOrientation& orientation);

}  // namespace ifov::geodesy
