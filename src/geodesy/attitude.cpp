#include "geodesy/attitude.h"

#include <cmath>

namespace ifov::geodesy {

FrameTransform<Enu, Body> enu_from_body(const Attitude& attitude) {
  const double cy = std::cos(attitude.yaw_rad), sy = std::sin(attitude.yaw_rad);
  const double cp = std::cos(attitude.pitch_rad), sp = std::sin(attitude.pitch_rad);
  const double cr = std::cos(attitude.roll_rad), sr = std::sin(attitude.roll_rad);
  // Columns of ned_from_body = Rz(yaw) Ry(pitch) Rx(roll); ENU swaps north and east and turns down into up.
  const auto enu_from_ned = [](double north, double east, double down) {
    return EnuVector{{east, north, -down}};
  };
  return {enu_from_ned(cy * cp, sy * cp, -sp),
          enu_from_ned(cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr),
          enu_from_ned(cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr)};
}

}  // namespace ifov::geodesy
