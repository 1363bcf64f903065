#include "io/document/shapes/measures.h"

#include <cmath>

#include "io/document/schema/quantity.h"

namespace ifov::io {
namespace {

math::Transform turn_z_to(math::Vec3 axis) {
  const math::Vec3 to = math::normalized(axis);
  const math::Vec3 about = math::cross({0.0, 0.0, 1.0}, to);
  const double sine = math::length(about);
  if (sine < 1e-12) return to.z > 0.0 ? math::Transform() : math::Transform::rotation({1.0, 0.0, 0.0}, M_PI);
  return math::Transform::rotation(about, std::atan2(sine, to.z));
}

}  // namespace

SchemaType<double> positive_length() { return quantity(kLength, Range::above(0.0, "m")); }

math::Transform upright_to(math::Point3 position_m, math::Vec3 direction) {
  return math::Transform::translation({position_m.x, position_m.y, position_m.z}) * turn_z_to(direction);
}

}  // namespace ifov::io
