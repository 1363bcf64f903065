#pragma once

#include <cmath>

/// The plan of a landscape: metres east and north.
namespace ifov::landscape {

struct Vec2 {
  double x = 0.0, y = 0.0;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(Vec2 a, double s) { return {a.x * s, a.y * s}; }
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double length(Vec2 a) { return std::hypot(a.x, a.y); }
inline Vec2 unit(Vec2 a) { return a * (1.0 / length(a)); }
/// Turned left by a right angle.
constexpr Vec2 left_of(Vec2 a) { return {-a.y, a.x}; }

/// A rectangle on the ground with axes of its own: `along` points to its right when it is looked at from the
/// front, `inward` from its front to its back.
struct Stand {
  Vec2 origin;
  Vec2 inward{0.0, 1.0};

  constexpr Vec2 along() const { return {inward.y, -inward.x}; }
  constexpr Vec2 at(double x_m, double y_m) const { return origin + along() * x_m + inward * y_m; }
  /// Counter-clockwise from east, of `along`.
  double rotation_rad() const { return std::atan2(along().y, along().x); }
};

/// An axis-aligned rectangle in the axes of a stand.
struct Footprint {
  Stand stand;
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;

  constexpr Vec2 corner(int k) const { return stand.at(k == 0 || k == 3 ? x0 : x1, k < 2 ? y0 : y1); }
  Footprint grown(double by_m) const { return {stand, x0 - by_m, x1 + by_m, y0 - by_m, y1 + by_m}; }
};

/// By separating axes.
bool overlap(const Footprint& a, const Footprint& b);
/// 0 inside.
double distance(const Footprint& footprint, Vec2 point);

}  // namespace ifov::landscape
