#pragma once

#include "geodesy/frames.h"

namespace ifov::geodesy {

/// How a body stands: the 3-2-1 sequence of aeronautics in north-east-down axes. Yaw (heading) clockwise from north,
/// pitch nose up, roll right wing down; all zero: level, the nose to the north.
struct Attitude {
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};

/// About the body's own place: a rotation alone.
FrameTransform<Enu, Body> enu_from_body(const Attitude& attitude);

}  // namespace ifov::geodesy
