#pragma once

#include "math/vec3.h"

namespace ifov::geodesy {
struct Attitude;
}

namespace ifov::sensor {

/// The camera frame seen from the scene (ENU): unit vectors, right x down = forward. `right` and `down` are
/// the directions in which image x and y grow; `forward` is the optical axis, towards the scene.
struct CameraAxes {
  math::Vec3 right{1.0, 0.0, 0.0};
  math::Vec3 down{0.0, -1.0, 0.0};
  math::Vec3 forward{0.0, 0.0, -1.0};
};

/// Optical axis from `position` to `target`; the image's upward direction is `up` made perpendicular to it.
/// ifov::InputError where target and position coincide or up is parallel to the line between them.
CameraAxes axes_looking_at(math::Point3 position_m, math::Point3 target_m, math::Vec3 up);

/// A camera fixed below an aircraft: its axis is the body's down, the top of the image its nose. Without yaw, pitch and
/// roll: nadir view, north at the top.
CameraAxes axes_from_attitude(const geodesy::Attitude& attitude);

}  // namespace ifov::sensor
