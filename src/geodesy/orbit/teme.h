#pragma once

#include "geodesy/earth_orientation.h"
#include "geodesy/frames.h"
#include "geodesy/utc_time.h"

namespace ifov::geodesy {

/// Origin in the Earth's centre, z to the true pole, x to the mean equinox: what Sgp4 gives positions in.
struct Teme {};
using TemePoint = PointIn<Teme>;
using TemeVector = VectorIn<Teme>;

/// A turn about the pole by the Greenwich mean sidereal time of 1982, and polar motion (Vallado et al. 2006, appendix C).
FrameTransform<Ecef, Teme> ecef_from_teme(UtcTime time, const EarthOrientation& orientation = {});

/// A velocity as seen from the turning Earth, m/s.
EcefVector ecef_velocity(const FrameTransform<Ecef, Teme>& ecef_from_teme, TemePoint position,
                         TemeVector velocity_m_s);

}  // namespace ifov::geodesy
