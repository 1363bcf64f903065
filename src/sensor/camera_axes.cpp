#include "sensor/camera_axes.h"

#include <cmath>

#include "core/error.h"

namespace ifov::sensor {

CameraAxes axes_looking_at(math::Point3 position_m, math::Point3 target_m, math::Vec3 up) {
  const math::Vec3 view = target_m - position_m;
  if (!(math::length(view) > 0.0))
    throw InputError("the camera's position and the point it looks at are the same");
  CameraAxes axes;
  axes.forward = math::normalized(view);
  const math::Vec3 right = math::cross(axes.forward, up);
  if (!(math::length(right) > 1e-9 * math::length(up)))
    throw InputError("the camera's \"up\" is parallel to its line of sight: choose another, such as north");
  axes.right = math::normalized(right);
  axes.down = math::cross(axes.forward, axes.right);
  return axes;
}

CameraAxes axes_from_yaw_pitch_roll(double yaw_rad, double pitch_rad, double roll_rad) {
  const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
  const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
  const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
  // Columns of ned_from_body = Rz(yaw) Ry(pitch) Rx(roll); ENU swaps north and east and turns down into up.
  const auto enu_from_ned = [](double north, double east, double down) {
    return math::Vec3{east, north, -down};
  };
  const math::Vec3 nose = enu_from_ned(cy * cp, sy * cp, -sp);
  const math::Vec3 right_wing = enu_from_ned(cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr);
  const math::Vec3 belly = enu_from_ned(cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr);
  return {right_wing, -nose, belly};
}

}  // namespace ifov::sensor
