#include "thermal/faces/time_table.h"

#include <algorithm>
#include <cmath>

namespace ifov::thermal {

double TimeTable::at(double t) const {
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), t);
  if (after == time_s.begin()) return value.front();
  if (after == time_s.end()) return value.back();
  const auto i = static_cast<std::size_t>(after - time_s.begin());
  return std::lerp(value[i - 1], value[i], (t - time_s[i - 1]) / (time_s[i] - time_s[i - 1]));
}

double TimeTable::mean(double from_s, double to_s) const {
  // Sum over the parts between the table's times, each a trapezium.
  double sum = 0.0, begin_s = from_s;
  for (auto next = std::upper_bound(time_s.begin(), time_s.end(), from_s); begin_s < to_s; ++next) {
    const double end_s = next == time_s.end() ? to_s : std::min(*next, to_s);
    sum += 0.5 * (at(begin_s) + at(end_s)) * (end_s - begin_s);
    begin_s = end_s;
    if (next == time_s.end()) break;
  }
  return sum / (to_s - from_s);
}

}  // namespace ifov::thermal
