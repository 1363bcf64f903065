#pragma once

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/chord.h"
#include "sampling/accuracy/borders/polygon.h"
#include "sampling/random.h"

namespace ifov::sampling {

/// Twice the area times three times the mean at the midpoints of a triangle's edges.
template <class Density>
double at_midpoints(Point2 o, Point2 p, Point2 q, const Density& density) {
  double h = 0.0;
  for (const Point2 m : {0.5 * (o + p), 0.5 * (p + q), 0.5 * (q + o)}) h += density(m);
  return cross(p - o, q - o) * h;
}

/// A fan of triangles, each by the rule of its three edge midpoints, exact to the second degree. None is longer than
/// `longest`: it is cut into n x n like it.
template <class Density>
double over_fan(const Polygon& polygon, const Density& density, double longest = INFINITY) {
  constexpr double kMostCuts = 32.0;
  double sum = 0.0;
  const Point2 o = polygon.vertex[0];
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const Point2 p = polygon.vertex[i], q = polygon.vertex[i + 1];
    const double side = std::max({length(p - o), length(q - p), length(o - q)});
    if (!(side > longest)) {
      sum += at_midpoints(o, p, q, density);
      continue;
    }
    const int n = static_cast<int>(std::min(kMostCuts, std::ceil(side / longest)));
    const Point2 u = (1.0 / n) * (p - o), v = (1.0 / n) * (q - o);
    for (int b = 0; b < n; ++b)
      for (int a = 0; a + b < n; ++a) {
        const Point2 corner = o + static_cast<double>(a) * u + static_cast<double>(b) * v;
        sum += at_midpoints(corner, corner + u, corner + v, density);
        if (a + b + 1 < n) sum += at_midpoints(corner + u, corner + u + v, corner + v, density);
      }
  }
  return sum / 6.0;
}

/// Of an area; of points, their mean. None of what crosses itself lies beyond the polygon.
inline Point2 centroid_of(const Polygon& polygon) {
  const Point2 o = polygon.vertex[0];
  Point2 moment{}, mean{}, low = o, high = o;
  double twice = 0.0;
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const Point2 p = polygon.vertex[i] - o, q = polygon.vertex[i + 1] - o;
    const double part = cross(p, q);
    moment = moment + part / 3.0 * (p + q);
    twice += part;
  }
  for (int i = 1; i < polygon.count; ++i) {
    const Point2 p = polygon.vertex[i];
    mean = mean + 1.0 / polygon.count * (p - o);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Point2 at = twice > 0.0 ? o + 1.0 / twice * moment : o + mean;
  return {std::clamp(at.x, low.x, high.x), std::clamp(at.y, low.y, high.y)};
}

}  // namespace ifov::sampling
