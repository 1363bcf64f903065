#pragma once

#include <vector>

#include "geodesy/frames.h"
#include "geodesy/utc_time.h"

namespace ifov::io {

struct OrbitPath;

/// A satellite's places over time, ECEF; seconds after an instant.
struct OrbitPoints {
  std::vector<double> times_s;
  std::vector<geodesy::EcefPoint> places;
};

/// Places from `from_s` to `to_s` after a time, and a second more at both ends, so close that a cubic spline through them is
/// within 0.1 um of SGP4 in low orbits: 5/384 of the orbit's fourth derivative times the step's fourth power. Throws InputError with the
/// place in the file, and where SGP4 finds no position.
OrbitPoints orbit_points(const OrbitPath& path, geodesy::UtcTime time, double from_s, double to_s);

/// From the elements' epoch to a time.
double orbit_age_days(const OrbitPath& path, geodesy::UtcTime time);

}  // namespace ifov::io
