#include "geodesy/earth_orientation.h"

#include <erfa.h>

#include "core/error.h"

namespace ifov::geodesy {
namespace {

/// Of a rotation whose rows are the axes of `To`, told in `From`.
template <class To, class From>
FrameTransform<To, From> rotation(const double (&m)[3][3]) {
  return {{{m[0][0], m[1][0], m[2][0]}}, {{m[0][1], m[1][1], m[2][1]}}, {{m[0][2], m[1][2], m[2][2]}}};
}

}  // namespace

FrameTransform<Ecef, Gcrs> ecef_from_gcrs(UtcTime time, const EarthOrientation& orientation) {
  double tai1, tai2, tt1, tt2, ut11, ut12, m[3][3];
  // 1 is a warning: leap seconds for that year are not known.
  if (eraUtctai(time.jd1, time.jd2, &tai1, &tai2) < 0 ||
      eraUtcut1(time.jd1, time.jd2, orientation.ut1_minus_utc_s, &ut11, &ut12) < 0)
    throw InputError(format("how the Earth is turned among the stars is not known at {}", format_utc(time)));
  eraTaitt(tai1, tai2, &tt1, &tt2);
  eraC2t06a(tt1, tt2, ut11, ut12, orientation.pole_x_rad, orientation.pole_y_rad, m);
  return rotation<Ecef, Gcrs>(m);
}

FrameTransform<Ecef, RotatingEquator> ecef_from_rotating_equator(const EarthOrientation& orientation) {
  double m[3][3];
  eraPom00(orientation.pole_x_rad, orientation.pole_y_rad, 0.0, m);
  return rotation<Ecef, RotatingEquator>(m);
}

}  // namespace ifov::geodesy
