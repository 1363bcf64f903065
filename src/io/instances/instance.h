#pragma once

#include <array>

#include "math/transform.h"

namespace ifov::io {

/// One copy of something: first scaled, then turned, then moved.
struct Instance {
  math::Point3 position_m;                               ///< where its own origin goes
  std::array<double, 4> quaternion{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z; of length 1
  math::Vec3 scale{1.0, 1.0, 1.0};                       ///< along its own axes, above zero
};

/// The turn by roll about x, then pitch about y, then yaw about z, each right-handed about the axes of the outer
/// frame: R = Rz(yaw) Ry(pitch) Rx(roll).
std::array<double, 4> quaternion_of(double yaw_rad, double pitch_rad, double roll_rad);

/// Yaw in (-pi, pi], pitch in [-pi/2, pi/2] and roll in (-pi, pi] of a turn; at a pitch of a right angle roll is 0.
std::array<double, 3> yaw_pitch_roll_of(const std::array<double, 4>& quaternion);

/// The frame of the list from that of the copy.
math::Transform transform_of(const Instance& instance);

}  // namespace ifov::io
