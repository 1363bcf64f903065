#pragma once

namespace ifov::atmosphere {

/// Half the width of the cells of a table of the sky beside the Sun, radians across the sky; none: the sky as it is.
struct SunCell {
  double along_zenith_rad = 0.0, along_azimuth_rad = 0.0;
  bool any() const { return along_zenith_rad > 0.0 && along_azimuth_rad > 0.0; }
};

}  // namespace ifov::atmosphere
