#pragma once

#include <vector>

namespace ifov::thermal {

/// A quantity over time, seconds since 1970 in rising order: linear between, the first and the last hold beyond.
struct TimeTable {
  std::vector<double> time_s, value;
  double at(double time_s) const;
  /// Over a time of a length above 0.
  double mean(double from_s, double to_s) const;
};

}  // namespace ifov::thermal
