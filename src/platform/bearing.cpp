#include "platform/bearing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/format.h"

namespace ifov::platform {

std::string angles_told(std::span<const geodesy::Attitude> angles) {
  constexpr double kToDegrees = 180.0 / std::numbers::pi;
  struct Axis {
    const char* name;
    double geodesy::Attitude::*angle;
  };
  constexpr std::array<Axis, 3> kAxes{{{"yaw", &geodesy::Attitude::yaw_rad},
                                       {"pitch", &geodesy::Attitude::pitch_rad},
                                       {"roll", &geodesy::Attitude::roll_rad}}};
  std::string told;
  for (const Axis& axis : kAxes) {
    // One after the other, so that a turn through 180 deg is no jump.
    double at = angles.front().*axis.angle, least = at, most = at;
    for (const geodesy::Attitude& next : angles) {
      at += std::remainder(next.*axis.angle - at, 2.0 * std::numbers::pi);
      least = std::min(least, at);
      most = std::max(most, at);
    }
    if (least == 0.0 && most == 0.0) continue;
    const double from = least * kToDegrees, to = most * kToDegrees;
    told += format("{}{} {}", told.empty() ? "" : ", ", axis.name,
                   to - from < 1e-4 ? format("{:.4g} deg", to) : format("{:.4g} to {:.4g} deg", from, to));
  }
  return told.empty() ? "not turned" : told;
}

}  // namespace ifov::platform
