#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sampling/accuracy/borders/polygon.h"

namespace ifov::sampling {

inline Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
inline Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
inline Point2 operator*(double s, Point2 a) { return {s * a.x, s * a.y}; }
inline double length(Point2 a) { return std::sqrt(a.x * a.x + a.y * a.y); }
inline double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }

inline double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const Point2 to = p - a, d = b - a;
  const double square = dot(d, d);
  const double t = square > 0.0 ? std::clamp(dot(to, d) / square, 0.0, 1.0) : 0.0;
  return length(to - t * d);
}

/// Sagitta above which an arc is not taken on trust, as a share of its chord.
constexpr double kLargestSagitta = 0.22;

/// Signed curvature of the circle through three points (positive: turning from x to y): 4 area / (a b c). Two of the
/// sides are known.
inline double menger_curvature(Point2 p, Point2 q, Point2 r, double pq, double qr) {
  const double sides = pq * qr * length(r - p);
  return sides > 0.0 ? 2.0 * cross(q - p, r - q) / sides : 0.0;
}

/// Height of the arc of this curvature above a chord of length c, along the left normal of the chord
/// (-direction.y, direction.x); an arc turning towards the left bulges to the right, hence the sign.
inline double sagitta_of_curvature(double curvature, double c) {
  const double half_angle_sine = std::clamp(0.5 * curvature * c, -0.95, 0.95);
  if (std::abs(half_angle_sine) < 1e-9) return 0.0;
  return -0.5 * c * (1.0 - std::sqrt(1.0 - half_angle_sine * half_angle_sine)) / half_angle_sine;
}

/// Area between a chord of length c and the arc of sagitta s over it: R^2 (theta - sin theta cos theta) in
/// terms of t = tan(theta / 2) = 2 s / c. The bracket, atan t - t (1 - t^2) / (1 + t^2)^2, cancels to the
/// third order; for shallow arcs its power series with coefficients 4 k (k + 1) / (2 k + 1) takes its place.
inline double circular_segment_area(double c, double s) {
  const double t = 2.0 * std::abs(s) / c, square = t * t, one = 1.0 + square;
  double series;  // of the bracket over t^3
  if (square < 0.01)
    series =
        8.0 / 3.0 -
        square *
            (24.0 / 5.0 -
             square * (48.0 / 7.0 - square * (80.0 / 9.0 - square * (120.0 / 11.0 - square * 168.0 / 13.0))));
  else
    series = (std::atan(t) - t * (1.0 - square) / (one * one)) / (square * t);
  return 0.125 * c * c * one * one * t * series;
}

/// atan(t) / t for |t| <= 1, within 3e-4 (Pade approximant [4/4]): enough for what scales a variance.
inline double atan_over_argument(double t) {
  const double square = t * t;
  return (945.0 + square * (735.0 + square * 64.0)) / (945.0 + square * (1050.0 + square * 225.0));
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
