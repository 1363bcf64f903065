#include "materials/mirror.h"

namespace ifov::materials {

ScatterSample Mirror::sample(math::Vec3 outgoing, math::Normal3 normal, double, double) const {
  const math::Vec3 incoming = 2.0 * math::dot(normal, outgoing) * normal.as_vector() - outgoing;
  return {math::normalized(incoming), 1.0, 0.0, true};
}

}  // namespace ifov::materials
