#pragma once

#include <vector>

namespace ifov::thermal {

/// Heat from inside over time, seconds since 1970 in rising order: linear between, the first and the last hold beyond.
struct PowerTable {
  std::vector<double> time_s, w_m2;
  /// Over a time of a length above 0.
  double mean_w_m2(double from_s, double to_s) const;
};

}  // namespace ifov::thermal
