#pragma once

#include <cassert>

#include "math/vec3.h"

namespace ifov::math {

/// A right-handed orthonormal frame about a normal: local z is the normal.
struct Frame {
  Vec3 x, y, z;

  Vec3 outer_from_local(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 local_from_outer(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

/// `n` has length 1. Branch-free but for the sign, without a bad direction: Duff et al., "Building an
/// Orthonormal Basis, Revisited", JCGT 6(1), 2017.
inline Frame frame_from_normal(Normal3 n) {
  assert(std::abs(dot(n.as_vector(), n.as_vector()) - 1.0) < 1e-6);
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {
      {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n.as_vector()};
}

}  // namespace ifov::math
