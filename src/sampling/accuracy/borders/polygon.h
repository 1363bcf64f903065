#pragma once

#include <cmath>
#include <cstddef>

#include "sampling/random.h"

namespace ifov::sampling {

/// A polygon of a few vertices, without allocation: a cell's corners, a curve's knots, cut by a rectangle.
struct Polygon {
  static constexpr int kCapacity = 20;
  Point2 vertex[kCapacity];
  int count = 0;

  void add(Point2 p) { vertex[count++] = p; }

  /// Signed area (shoelace): positive where x to y turns the way the vertices go.
  double signed_area() const {
    double twice = 0.0;
    for (int i = 0, j = count - 1; i < count; j = i++)
      twice += vertex[j].x * vertex[i].y - vertex[i].x * vertex[j].y;
    return 0.5 * twice;
  }

  /// Even-odd rule.
  bool contains(Point2 p) const {
    bool inside = false;
    for (int i = 0, j = count - 1; i < count; j = i++) {
      const Point2 a = vertex[i], b = vertex[j];
      if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
    return inside;
  }

  /// The part of this polygon with a x + b y <= c (Sutherland and Hodgman 1974).
  Polygon clipped(double a, double b, double c) const {
    Polygon out;
    for (int i = 0; i < count; ++i) {
      const Point2 p = vertex[i], q = vertex[(i + 1) % count];
      const double dp = a * p.x + b * p.y - c, dq = a * q.x + b * q.y - c;
      if (dp <= 0.0) out.add(p);
      if ((dp < 0.0 && dq > 0.0) || (dp > 0.0 && dq < 0.0)) {
        const double t = dp / (dp - dq);
        out.add({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      }
    }
    return out;
  }
};

}  // namespace ifov::sampling
