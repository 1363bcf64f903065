#pragma once

#include "geodesy/attitude.h"

namespace ifov::platform {

/// How a body stands in the scene: a rotation alone.
using Stance = geodesy::FrameTransform<geodesy::Enu, geodesy::Body>;

/// The belly exactly along `down`, the nose as near to `ahead` as that leaves; scene frame, any lengths. Not numbers where one is
/// zero or both are parallel.
Stance belly_along(math::Vec3 down, math::Vec3 ahead);

/// The nose exactly along `ahead`, the belly as near to `down` as that leaves; likewise.
Stance nose_along(math::Vec3 ahead, math::Vec3 down);

/// Turned about its own axes: yaw about the belly's, then pitch, then roll (3-2-1); positive yaw to the right, pitch nose up, roll right
/// wing down.
Stance turned(const Stance& stance, const geodesy::Attitude& angles);

}  // namespace ifov::platform
