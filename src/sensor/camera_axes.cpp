#include "sensor/camera_axes.h"

#include "core/error.h"
#include "geodesy/attitude.h"

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

CameraAxes axes_from_attitude(const geodesy::Attitude& attitude) {
  const auto enu_from_body = geodesy::enu_from_body(attitude);
  return {enu_from_body.y().v, -enu_from_body.x().v, enu_from_body.z().v};
}

}  // namespace ifov::sensor
