#pragma once

#include "math/frame.h"

namespace ifov::materials {

/// z along the normal, x along the tangent as far as it lies in the surface; any x where there is no tangent.
inline math::Frame facet_frame(math::Normal3 normal, math::Vec3 tangent) {
  const math::Vec3 n = normal.as_vector(), flat = tangent - math::dot(n, tangent) * n;
  const double length = math::length(flat);
  if (!(length > 1e-9)) return math::frame_from_normal(normal);
  const math::Vec3 x = flat / length;
  return {x, math::cross(n, x), n};
}

}  // namespace ifov::materials
