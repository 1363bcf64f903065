#pragma once

#include <cmath>

namespace ifov::math {

/// A displacement or direction, metres or unitless, in the frame that its name states.
struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return a * s; }
  friend constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalized(Vec3 a) { return a / length(a); }

/// A position in metres.
struct Point3 {
  double x = 0.0, y = 0.0, z = 0.0;
  friend constexpr Point3 operator+(Point3 p, Vec3 v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
  friend constexpr Point3 operator-(Point3 p, Vec3 v) { return {p.x - v.x, p.y - v.y, p.z - v.z}; }
  friend constexpr Vec3 operator-(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr bool operator==(const Point3&, const Point3&) = default;
};

/// A surface normal: transforms by the inverse transpose.
struct Normal3 {
  double x = 0.0, y = 0.0, z = 0.0;
  constexpr Vec3 as_vector() const { return {x, y, z}; }
  friend constexpr Normal3 operator-(Normal3 n) { return {-n.x, -n.y, -n.z}; }
  friend constexpr bool operator==(const Normal3&, const Normal3&) = default;
};

constexpr Normal3 as_normal(Vec3 v) { return {v.x, v.y, v.z}; }
constexpr double dot(Normal3 n, Vec3 v) { return n.x * v.x + n.y * v.y + n.z * v.z; }

}  // namespace ifov::math
