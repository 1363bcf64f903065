#include "geodesy/orbit/teme.h"

#include <erfa.h>

#include <cmath>

namespace ifov::geodesy {
namespace {

constexpr double kSecondsPerDay = 86400.0;

}  // namespace

FrameTransform<Ecef, Teme> ecef_from_teme(UtcTime time, const EarthOrientation& orientation) {
  const double turned = eraGmst82(time.jd1, time.jd2 + orientation.ut1_minus_utc_s / kSecondsPerDay);
  const double c = std::cos(turned), s = std::sin(turned);
  const FrameTransform<RotatingEquator, Teme> of_equator({{c, -s, 0.0}}, {{s, c, 0.0}}, {{0.0, 0.0, 1.0}});
  return ecef_from_rotating_equator(orientation) * of_equator;
}

EcefVector ecef_velocity(const FrameTransform<Ecef, Teme>& ecef_from_teme, TemePoint position,
                         TemeVector velocity_m_s) {
  const EcefPoint at = ecef_from_teme(position);
  const EcefVector turning{{-kEarthRotation_rad_s * at.p.y, kEarthRotation_rad_s * at.p.x, 0.0}};
  return ecef_from_teme(velocity_m_s) - turning;
}

}  // namespace ifov::geodesy
