#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ifov::geometry {

/// When an object is there. Seconds after the document's instant.
struct Presence {
  /// From `begin_s` on, and no more at `end_s`.
  struct Interval {
    double begin_s = 0.0, end_s = 0.0;
  };
  std::vector<Interval> intervals;  ///< in order, apart from each other; one or more

  bool at(double time_s) const {
    return std::any_of(intervals.begin(), intervals.end(),
                       [&](const Interval& i) { return time_s >= i.begin_s && time_s < i.end_s; });
  }

  /// The time next to this one at which it is there.
  double nearest(double time_s) const {
    double best_s = std::numeric_limits<double>::infinity();
    for (const Interval& i : intervals) {
      const double in_it_s = std::clamp(time_s, i.begin_s, std::nextafter(i.end_s, i.begin_s));
      if (std::abs(in_it_s - time_s) < std::abs(best_s - time_s)) best_s = in_it_s;
    }
    return best_s;
  }

  /// Whether it is not as at the document's instant at some time between these.
  bool is_otherwise_within(double low_s, double high_s) const {
    if (at(low_s) != at(0.0)) return true;
    return std::any_of(intervals.begin(), intervals.end(), [&](const Interval& i) {
      const auto within = [&](double edge_s) { return edge_s > low_s && edge_s < high_s; };
      return within(i.begin_s) || within(i.end_s);
    });
  }
};

}  // namespace ifov::geometry
