#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sampling/accuracy/edges/chord.h"
#include "sampling/field.h"

namespace ifov::sampling {

/// Width of the error claimed for a junction, in units of that to which it was located: the borders may meet
/// outside the three points that were seen.
constexpr double kJunctionClaim = 1.6;

/// Where three labels meet in a cell: a border runs straight from a crossing on each of three sides to one
/// point. Border i starts on side[i]; sector i, between borders i and i + 1, holds the corners side[i] + 1
/// ... side[i + 1].
struct Junction {
  std::uint32_t cell = 0;
  std::uint32_t bracket[3] = {};
  std::uint32_t sector[3] = {};  ///< labels
  std::uint8_t side[3] = {};
  bool located = false;
  Point2 at;
  double width = 0.0;        ///< to which it was located, in any direction, px
  double leg_width[3] = {};  ///< width of the error claimed for the middle of each border, px
  double wanted = 0.0;       ///< what the tolerance allows to both
};

/// A straight line that a border is expected to follow: through `through` along `along` (unit length), with
/// the variance of the distance by which the border may miss it.
struct ExpectedLine {
  Point2 through, along;
  double variance = 0.0;
};

/// The likeliest meeting point of borders that follow the lines, if nothing else is known than that it lies
/// about `middle`, with the given variance along each axis: weighted least squares.
inline Point2 meeting_point(Point2 middle, double variance, const ExpectedLine* lines, int count) {
  double xx = 1.0 / variance, xy = 0.0, yy = xx, bx = 0.0, by = 0.0;
  for (int i = 0; i < count; ++i) {
    const Point2 n{-lines[i].along.y, lines[i].along.x};
    const double weight = 1.0 / lines[i].variance, offset = weight * dot(n, lines[i].through - middle);
    xx += weight * n.x * n.x;
    xy += weight * n.x * n.y;
    yy += weight * n.y * n.y;
    bx += offset * n.x;
    by += offset * n.y;
  }
  const double determinant = xx * yy - xy * xy;
  return middle + Point2{(yy * bx - xy * by) / determinant, (xx * by - xy * bx) / determinant};
}

/// Square of the radiance that a junction's three sectors exchange for one unit of its motion in either
/// direction, by pairs: moving `at` by e changes the area of sector i by e x (crossing[i + 1] - crossing[i])
/// / 2. Border i is the pair of the sectors i - 1 and i. Negative terms (obtuse triangles) are left away.
inline double exchanged_by_motion(const Point2 crossing[3], int border) {
  const Point2 before = crossing[border] - crossing[(border + 2) % 3];
  const Point2 after = crossing[(border + 1) % 3] - crossing[border];
  return 0.25 * std::max(0.0, -dot(before, after));
}

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
