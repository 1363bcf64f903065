#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sampling/accuracy/borders/chord.h"
#include "sampling/field.h"

namespace ifov::sampling {

/// A junction on its way through verification.
struct JunctionCheck {
  enum class Stage { confirm, narrow, cross_over, legs, done };
  std::uint32_t cell = 0;
  Stage stage = Stage::confirm;
  int rounds = 0;
  Point2 crossing[3], at, opposite;
  std::uint32_t sector[3] = {};
  Point2 seen_in[3];  ///< a point in each sector: the borders meet between them
  double tolerance = 0.0, width = 0.0;
  double leg_tolerance[3] = {};
  std::size_t first_point = 0;

  /// Points in the three sectors, `tolerance` from their borders.
  void aim() {
    for (int i = 0; i < 3; ++i) {
      const Point2 u = crossing[i] - at, v = crossing[(i + 1) % 3] - at;
      double angle = std::atan2(cross(u, v), dot(u, v));
      if (angle < 0.0) angle += 2.0 * std::numbers::pi;
      const double half = 0.5 * angle, c = std::cos(half), s = std::sin(half);
      const double reach = tolerance / std::max(s, 0.4) / std::max(length(u), 1e-12);
      seen_in[i] = at + reach * Point2{c * u.x - s * u.y, s * u.x + c * u.y};
    }
  }

  /// The longest side of the triangle of seen points, as its first corner (the second is the next).
  int longest_side() const {
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (length(seen_in[(i + 1) % 3] - seen_in[i]) > length(seen_in[(longest + 1) % 3] - seen_in[longest]))
        longest = i;
    return longest;
  }

  /// Width of a uniform error of the same variance along an axis as a point anywhere in the triangle has.
  double triangle_width() const {
    double squares = 0.0;
    for (int i = 0; i < 3; ++i) {
      const Point2 d = seen_in[(i + 1) % 3] - seen_in[i];
      squares += dot(d, d);
    }
    return std::sqrt(squares / 6.0);
  }

  void add_points(std::vector<FocalPoint>& points) const {
    const auto add = [&](Point2 p) { points.push_back({p.x, p.y}); };
    if (stage == Stage::confirm) {
      for (const Point2 p : seen_in) add(p);
    } else if (stage == Stage::narrow) {
      const int i = longest_side();
      add(0.5 * (seen_in[i] + seen_in[(i + 1) % 3]));
    } else if (stage == Stage::cross_over) {
      add(opposite);
    } else if (stage == Stage::legs) {
      for (int i = 0; i < 3; ++i) {
        if (leg_tolerance[i] == 0.0) continue;
        const Point2 leg = at - crossing[i], middle = 0.5 * (at + crossing[i]);
        const double reach = length(leg);
        const Point2 across{-leg.y / reach, leg.x / reach};  // towards sector i - 1
        add(middle + leg_tolerance[i] * across);
        add(middle - leg_tolerance[i] * across);
      }
    }
  }
};

}  // namespace ifov::sampling
