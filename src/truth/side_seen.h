#pragma once

#include "geometry/surface_point.h"
#include "scene/resolved_surface.h"

namespace ifov::truth {

/// The normal by which light is reflected (vertex normals and reliefs of materials included), unit, on the side that is seen.
inline math::Vec3 normal_seen(const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface) {
  const math::Vec3 normal = surface.shading_normal.as_vector();
  return hit.front ? normal : -normal;
}

}  // namespace ifov::truth
