#pragma once

#include "geometry/surface_point.h"
#include "scene/resolved_surface.h"
#include "transport/surface_lobe.h"

namespace ifov::transport {

/// How a surface is seen from a direction away from it, by a ray that met it on that side: where a ray is to be reflected or let
/// through, and shares depend on the angle alone.
inline materials::BsdfEvent delta_view(math::Vec3 away, const geometry::SurfacePoint& hit,
                                       const scene::ResolvedSurface& surface) {
  materials::BsdfEvent view;
  view.outgoing = away;
  view.normal = hit.front ? surface.shading_normal : -surface.shading_normal;
  // A shading normal that turns away from the ray does not count.
  if (!(view.outgoing_cosine() > 0.0)) view.normal = hit.front ? hit.geometric_normal : -hit.geometric_normal;
  return view;
}

/// Where a ray goes on that passes a surface.
inline math::Point3 beyond_surface(const geometry::SurfacePoint& hit) {
  const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
  return hit.position_m - hit.offset_m * outward;
}

}  // namespace ifov::transport
