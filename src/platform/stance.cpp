#include "platform/stance.h"

namespace ifov::platform {
namespace {

Stance of_columns(math::Vec3 nose, math::Vec3 right, math::Vec3 belly) { return {{nose}, {right}, {belly}}; }

}  // namespace

Stance belly_along(math::Vec3 down, math::Vec3 ahead) {
  const math::Vec3 belly = math::normalized(down), right = math::normalized(math::cross(belly, ahead));
  return of_columns(math::cross(right, belly), right, belly);
}

Stance nose_along(math::Vec3 ahead, math::Vec3 down) {
  const math::Vec3 nose = math::normalized(ahead), right = math::normalized(math::cross(down, nose));
  return of_columns(nose, right, math::cross(nose, right));
}

Stance turned(const Stance& stance, const geodesy::Attitude& angles) {
  // The same sequence in north-east-down axes, told in ENU: north stands for the nose, east for the right wing.
  const Stance level = geodesy::enu_from_body(angles);
  const auto about_body = [](geodesy::EnuVector v) { return geodesy::BodyVector{{v.v.y, v.v.x, -v.v.z}}; };
  return {stance(about_body(level.x())), stance(about_body(level.y())), stance(about_body(level.z()))};
}

}  // namespace ifov::platform
