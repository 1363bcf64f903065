#include "radiometry/polarization_frame.h"

#include <algorithm>
#include <cmath>

namespace ifov::radiometry {

using math::Vec3;

PolarizationFrame meridional_frame(double mu, double azimuth_rad) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - mu * mu));
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  return {{sine * c, sine * s, mu}, {mu * c, mu * s, -sine}};
}

PolarizationFrame meridional_frame(Vec3 direction) {
  const double sine = std::hypot(direction.x, direction.y), mu = direction.z;
  if (!(sine > 0.0)) return meridional_frame(std::copysign(1.0, mu), 0.0);
  return {direction, {mu * direction.x / sine, mu * direction.y / sine, -sine}};
}

PolarizationFrame carried(const PolarizationFrame& frame, Vec3 direction) {
  const double along = dot(frame.x, direction) / (1.0 + dot(frame.direction, direction));
  return {direction, normalized(frame.x - along * (frame.direction + direction))};
}

PolarizationFrame surface_frame(Vec3 direction, Vec3 normal) {
  constexpr double kNoPlane = 1e-9;
  const Vec3 across = cross(direction, normal);
  const double sine = length(across);
  if (sine < kNoPlane) return meridional_frame(direction);
  return {direction, cross(across / sine, direction)};
}

MuellerMatrix turned(const PolarizationFrame& from, const PolarizationFrame& to) {
  return MuellerMatrix::turned_frame(dot(to.x, from.x), dot(to.x, from.y()));
}

ScatteringFrames scattering_frames(Vec3 before, Vec3 after) {
  constexpr double kNoPlane = 1e-12;
  const Vec3 across = cross(before, after);
  const double sine = length(across);
  const Vec3 y = sine < kNoPlane ? meridional_frame(after).y() : across / sine;
  return {{before, cross(y, before)}, {after, cross(y, after)}};
}

MuellerMatrix about(const MuellerMatrix& matrix, const ScatteringFrames& own, const PolarizationFrame& before,
                    const PolarizationFrame& after) {
  return turned(own.after, after) * matrix * turned(before, own.before);
}

}  // namespace ifov::radiometry
