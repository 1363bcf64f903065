#include "io/instances/instance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::io {

std::array<double, 4> quaternion_of(double yaw_rad, double pitch_rad, double roll_rad) {
  const double cy = std::cos(0.5 * yaw_rad), sy = std::sin(0.5 * yaw_rad);
  const double cp = std::cos(0.5 * pitch_rad), sp = std::sin(0.5 * pitch_rad);
  const double cr = std::cos(0.5 * roll_rad), sr = std::sin(0.5 * roll_rad);
  return {cy * cp * cr + sy * sp * sr, cy * cp * sr - sy * sp * cr, cy * sp * cr + sy * cp * sr,
          sy * cp * cr - cy * sp * sr};
}

std::array<double, 3> yaw_pitch_roll_of(const std::array<double, 4>& quaternion) {
  const auto [w, x, y, z] = quaternion;
  const double sine = std::clamp(2.0 * (w * y - x * z), -1.0, 1.0);
  // Within this of a right angle yaw and roll turn about the same axis.
  if (std::abs(sine) > 1.0 - 1e-14)
    return {2.0 * std::atan2(z, w), std::copysign(0.5 * std::numbers::pi, sine), 0.0};
  return {std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)), std::asin(sine),
          std::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))};
}

math::Transform transform_of(const Instance& instance) {
  const auto [w, x, y, z] = instance.quaternion;
  const math::Vec3 s = instance.scale;
  return math::Transform::from_columns(
      math::Vec3{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)} * s.x,
      math::Vec3{2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)} * s.y,
      math::Vec3{2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)} * s.z,
      instance.position_m);
}

}  // namespace ifov::io
