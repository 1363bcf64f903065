#pragma once

#include "geodesy/frames.h"

namespace ifov::platform {

/// A rotation, scalar first (w + x i + y j + z k); of length 1 where it stands for one. As scene_from_body it takes the
/// body's axes (nose, right wing, belly) to the scene.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
};

double length(const Quaternion& q);

/// Of a rotation's columns (Shepperd 1978, J. Guidance and Control 1, 223), w not negative.
Quaternion quaternion_of(const geodesy::FrameTransform<geodesy::Enu, geodesy::Body>& enu_from_body);

/// The rotation of q / |q|.
geodesy::FrameTransform<geodesy::Enu, geodesy::Body> rotation_of(const Quaternion& q);

}  // namespace ifov::platform
