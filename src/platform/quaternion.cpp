#include "platform/quaternion.h"

#include <cmath>

namespace ifov::platform {

using geodesy::Body;
using geodesy::Enu;
using geodesy::FrameTransform;

double length(const Quaternion& q) { return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z); }

Quaternion quaternion_of(const FrameTransform<Enu, Body>& enu_from_body) {
  const math::Vec3 a = enu_from_body.x().v, b = enu_from_body.y().v, c = enu_from_body.z().v;
  const double trace = a.x + b.y + c.z;
  Quaternion q;
  if (trace >= a.x && trace >= b.y && trace >= c.z) {
    q = {1.0 + trace, b.z - c.y, c.x - a.z, a.y - b.x};
  } else if (a.x >= b.y && a.x >= c.z) {
    q = {b.z - c.y, 1.0 + a.x - b.y - c.z, a.y + b.x, c.x + a.z};
  } else if (b.y >= c.z) {
    q = {c.x - a.z, a.y + b.x, 1.0 - a.x + b.y - c.z, b.z + c.y};
  } else {
    q = {a.y - b.x, c.x + a.z, b.z + c.y, 1.0 - a.x - b.y + c.z};
  }
  const double scale = (q.w < 0.0 ? -1.0 : 1.0) / length(q);
  return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

FrameTransform<Enu, Body> rotation_of(const Quaternion& q) {
  const double s = 2.0 / (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {{{1.0 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y + q.w * q.z), s * (q.x * q.z - q.w * q.y)}},
          {{s * (q.x * q.y - q.w * q.z), 1.0 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z + q.w * q.x)}},
          {{s * (q.x * q.z + q.w * q.y), s * (q.y * q.z - q.w * q.x), 1.0 - s * (q.x * q.x + q.y * q.y)}}};
}

}  // namespace ifov::platform
