#include "sampling/warp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::sampling {

using math::Vec3;
using std::numbers::pi;

Point2 uniform_disk(Point2 u) {
  const double a = 2.0 * u.x - 1.0, b = 2.0 * u.y - 1.0;
  if (a == 0.0 && b == 0.0) return {0.0, 0.0};
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const double angle = wide ? (pi / 4.0) * (b / a) : pi / 2.0 - (pi / 4.0) * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Point2 uniform_disk_inverse(Point2 p) {
  const double radius = std::sqrt(p.x * p.x + p.y * p.y);
  if (radius == 0.0) return {0.5, 0.5};
  double a, b;
  if (std::abs(p.x) > std::abs(p.y)) {
    a = std::copysign(radius, p.x);
    b = a * std::atan(p.y / p.x) * (4.0 / pi);
  } else {
    b = std::copysign(radius, p.y);
    a = b * std::atan(p.x / p.y) * (4.0 / pi);
  }
  return {0.5 * (a + 1.0), 0.5 * (b + 1.0)};
}

Vec3 cosine_hemisphere(Point2 u) {
  const Point2 p = uniform_disk(u);
  return {p.x, p.y, std::sqrt(std::max(0.0, 1.0 - p.x * p.x - p.y * p.y))};
}

double cosine_hemisphere_density(Vec3 direction) { return std::max(0.0, direction.z) / pi; }

Point2 cosine_hemisphere_inverse(Vec3 direction) { return uniform_disk_inverse({direction.x, direction.y}); }

TangentFrame::TangentFrame(Vec3 unit_normal) : normal(unit_normal) {
  const double sign = std::copysign(1.0, normal.z);
  const double a = -1.0 / (sign + normal.z);
  const double b = normal.x * normal.y * a;
  first = {1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
  second = {b, sign + normal.y * normal.y * a, -normal.y};
}

namespace {

double versine(double angle_rad) {
  const double s = std::sin(0.5 * angle_rad);
  return 2.0 * s * s;
}

}  // namespace

UniformCone::UniformCone(double half_angle_rad)
    : versine_(versine(half_angle_rad)), solid_angle_(2.0 * pi * versine_) {}

// The disk is lifted onto the cap by Lambert's equal-area map: radius r of the unit disk goes to 1 - cos =
// r^2 v.
Vec3 UniformCone::sample(Vec3 axis, Point2 u) const {
  const Point2 p = uniform_disk(u);
  const double depth = (p.x * p.x + p.y * p.y) * versine_;
  const double scale = std::sqrt(versine_ * (2.0 - depth));
  return TangentFrame(axis).to_world({p.x * scale, p.y * scale, 1.0 - depth});
}

double UniformCone::density(Vec3 axis, Vec3 direction) const {
  const Vec3 chord = direction - axis;
  return math::dot(chord, chord) <= 2.0 * versine_ ? 1.0 / solid_angle_ : 0.0;
}

Point2 UniformCone::inverse(Vec3 axis, Vec3 direction) const {
  const Vec3 chord = direction - axis;
  const double depth = 0.5 * math::dot(chord, chord);
  const Vec3 local = TangentFrame(axis).to_local(direction);
  const double scale = std::sqrt(versine_ * (2.0 - depth));
  return uniform_disk_inverse({local.x / scale, local.y / scale});
}

namespace {

/// Axes of the ellipse that a cap about `axis` projects onto the plane of a surface.
struct EllipseFrame {
  Vec3 towards, across;  // unit, in the plane: along the axis's shadow, and at right angles to it
  double sine;           // length of the axis's projection on the plane
  double cosine;         // height of the axis above it
};

EllipseFrame ellipse_frame(Vec3 axis, Vec3 normal) {
  EllipseFrame f;
  f.cosine = math::dot(axis, normal);
  const Vec3 across = math::cross(normal, axis);
  f.sine = math::length(across);
  if (f.sine > 1e-12) {
    f.across = across / f.sine;
    f.towards = math::cross(f.across, normal);
  } else {
    const TangentFrame frame(normal);
    f.towards = frame.first;
    f.across = frame.second;
  }
  return f;
}

}  // namespace

SolarDisc::SolarDisc(double half_angle_rad)
    : cone_(half_angle_rad), sine_(std::sin(half_angle_rad)), cosine_(std::cos(half_angle_rad)) {}

double SolarDisc::projected_solid_angle_sr(Vec3 axis, Vec3 normal) const {
  return pi * sine_ * sine_ * math::dot(axis, normal);
}

LightSample SolarDisc::sample(Vec3 axis, Vec3 normal, Point2 u) const {
  if (!uncut(axis, normal)) {
    const Vec3 direction = cone_.sample(axis, u);
    return {direction, cone_.solid_angle_sr() * std::max(0.0, math::dot(normal, direction))};
  }
  const EllipseFrame f = ellipse_frame(axis, normal);
  const Point2 p = uniform_disk(u);
  const double along = cosine_ * f.sine + sine_ * f.cosine * p.x;
  const double sideways = sine_ * p.y;
  const double height = std::sqrt(std::max(0.0, 1.0 - along * along - sideways * sideways));
  return {along * f.towards + sideways * f.across + height * normal, pi * sine_ * sine_ * f.cosine};
}

double SolarDisc::density(Vec3 axis, Vec3 normal, Vec3 direction) const {
  const double in_cone = cone_.density(axis, direction);
  if (in_cone == 0.0 || !uncut(axis, normal)) return in_cone;
  return std::max(0.0, math::dot(normal, direction)) / projected_solid_angle_sr(axis, normal);
}

Point2 SolarDisc::inverse(Vec3 axis, Vec3 normal, Vec3 direction) const {
  if (!uncut(axis, normal)) return cone_.inverse(axis, direction);
  const EllipseFrame f = ellipse_frame(axis, normal);
  return uniform_disk_inverse({(math::dot(direction, f.towards) - cosine_ * f.sine) / (sine_ * f.cosine),
                               math::dot(direction, f.across) / sine_});
}

}  // namespace ifov::sampling
