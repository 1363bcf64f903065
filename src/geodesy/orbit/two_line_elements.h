#pragma once

#include <string_view>

#include "geodesy/utc_time.h"

namespace ifov::geodesy {

/// Mean elements of an Earth satellite as a two-line element set gives them (Hoots and Roehrich 1980, Spacetrack Report No. 3). They
/// have a meaning in Sgp4 alone, which made them.
struct TwoLineElements {
  int catalogue_number = 0;
  UtcTime epoch;
  double inclination_rad = 0.0, ascending_node_rad = 0.0, eccentricity = 0.0, perigee_argument_rad = 0.0,
         mean_anomaly_rad = 0.0, mean_motion_rad_min = 0.0;
  double drag_bstar = 0.0;  ///< per Earth radius
};

/// Both lines, in fixed columns; what stands beyond column 69 is not read. Throws InputError that says which line and columns, what
/// was found and what is expected: a line's number, its checksum, one satellite in both, numbers, eccentricity and angles in range.
TwoLineElements parse_two_line_elements(std::string_view first, std::string_view second);

}  // namespace ifov::geodesy
