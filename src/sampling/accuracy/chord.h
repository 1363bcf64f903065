#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sampling/accuracy/polygon.h"

namespace ifov::sampling {

inline Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
inline Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
inline Point2 operator*(double s, Point2 a) { return {s * a.x, s * a.y}; }
inline double length(Point2 a) { return std::sqrt(a.x * a.x + a.y * a.y); }
inline double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }

/// Sagitta above which an arc is not taken on trust, as a share of its chord.
constexpr double kLargestSagitta = 0.22;

/// Signed curvature of the circle through three points (positive: turning from x to y): 4 area / (a b c).
inline double menger_curvature(Point2 p, Point2 q, Point2 r) {
  const double sides = length(q - p) * length(r - q) * length(r - p);
  return sides > 0.0 ? 2.0 * cross(q - p, r - q) / sides : 0.0;
}

/// Height of the arc of this curvature above a chord of length c, along the left normal of the chord
/// (-direction.y, direction.x); an arc turning towards the left bulges to the right, hence the sign.
inline double sagitta_of_curvature(double curvature, double c) {
  const double half_angle_sine = std::clamp(0.5 * curvature * c, -0.95, 0.95);
  if (std::abs(half_angle_sine) < 1e-9) return 0.0;
  return -0.5 * c * (1.0 - std::sqrt(1.0 - half_angle_sine * half_angle_sine)) / half_angle_sine;
}

/// Area between a chord of length c and the arc of sagitta s over it.
inline double circular_segment_area(double c, double s) {
  s = std::abs(s);
  if (s < 1e-6 * c) return 2.0 / 3.0 * s * c;
  const double half_angle = 2.0 * std::atan(2.0 * s / c);
  const double radius = (0.25 * c * c + s * s) / (2.0 * s);
  return radius * radius * (half_angle - std::sin(half_angle) * std::cos(half_angle));
}

/// Three knots of the arc over the chord a-b, scaled so that the polyline through them encloses exactly the
/// area of the circular segment of sagitta s (the parabola's own knots enclose 5/8 s c).
inline void arc_knots(Point2 a, Point2 b, double s, Point2 knots[3]) {
  const Point2 d = b - a;
  const double c = length(d);
  if (c == 0.0 || s == 0.0) {
    for (int i = 0; i < 3; ++i) knots[i] = a + 0.25 * (i + 1) * d;
    return;
  }
  const Point2 normal{-d.y / c, d.x / c};
  const double scale = circular_segment_area(c, s) / (0.625 * std::abs(s) * c);
  for (int i = 0; i < 3; ++i) {
    const double f = 0.25 * (i + 1);
    knots[i] = a + f * d + (4.0 * f * (1.0 - f) * s * scale) * normal;
  }
}

}  // namespace ifov::sampling
