#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sampling/accuracy/borders/chord.h"

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

}  // namespace ifov::sampling
