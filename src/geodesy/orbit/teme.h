#pragma once

#include "geodesy/frames.h"
#include "geodesy/utc_time.h"

namespace ifov::geodesy {

/// Origin in the Earth's centre, z to the true pole, x to the mean equinox: what Sgp4 gives positions in.
struct Teme {};
using TemePoint = PointIn<Teme>;
using TemeVector = VectorIn<Teme>;

/// A turn about the pole by the Greenwich mean sidereal time of 1982 (Vallado et al. 2006, appendix C); without polar motion, which is
/// 10 m on the ground. `ut1_minus_utc_s`: left at 0 it turns the Earth by up to 0.9 s, 420 m at the equator.
FrameTransform<Ecef, Teme> ecef_from_teme(UtcTime time, double ut1_minus_utc_s = 0.0);

/// A velocity as seen from the turning Earth, m/s.
EcefVector ecef_velocity(const FrameTransform<Ecef, Teme>& ecef_from_teme, TemePoint position,
                         TemeVector velocity_m_s);

}  // namespace ifov::geodesy
