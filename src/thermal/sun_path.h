#pragma once

#include <array>
#include <vector>

#include "geodesy/geodetic.h"

namespace ifov::thermal {

/// Where the Sun stands over a span of time: geodesy::sun_position each hour, which takes long, and cubic between, within
/// 1.5e-4 rad.
class SunPath {
 public:
  struct Place {
    double azimuth_rad = 0.0, elevation_rad = 0.0, distance_au = 1.0;
  };

  /// Times are seconds of UTC since 1970. Throws InputError as geodesy::sun_position does.
  SunPath(double begin_s, double end_s, const geodesy::Geodetic& place);
  Place at(double time_s) const;

 private:
  double begin_s_;
  std::vector<std::array<double, 4>> knots_;  ///< east, north, up, distance
};

/// When the Sun goes through the meridian next to a time, to seconds.
double solar_noon_s(double time_s, const geodesy::Geodetic& place);

}  // namespace ifov::thermal
