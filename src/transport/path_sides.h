#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/surface_point.h"
#include "math/vec3.h"
#include "transport/path_tracer.h"

namespace ifov::transport {

/// A shading normal is bent back until the viewer stands at least this far above its horizon (a cosine):
/// nobody sees a surface from behind.
inline constexpr double kLeastCosine = 1e-3;

inline math::Vec3 mirrored(math::Vec3 direction, math::Vec3 normal) {
  return direction - 2.0 * math::dot(direction, normal) * normal;
}

/// The surface as seen along a path: normals on the viewer's side.
struct PathTracer::Sides {
  math::Vec3 outgoing;  // towards the viewer
  double time_s;        // of the path
  math::Vec3 outward;   // geometric normal
  math::Normal3 shading;
  bool perturbed = false;  // the two differ

  /// An event towards the viewer, without the direction that light comes from.
  materials::BsdfEvent view(const SurfaceLobe& lobe, bool transmitted) const {
    materials::BsdfEvent event{
        outgoing, {}, shading, {}, transmitted ? materials::Side::transmitted : materials::Side::reflected};
    if (!lobe.isotropic) event.tangent = tangent();
    return event;
  }
  materials::BsdfEvent event(const SurfaceLobe& lobe, bool transmitted, math::Vec3 incoming) const {
    materials::BsdfEvent event = view(lobe, transmitted);
    event.incoming = incoming;
    return event;
  }
  /// East, along the surface; north where the surface faces east or west.
  math::Vec3 tangent() const {
    const math::Vec3 n = shading.as_vector();
    const math::Vec3 along = std::abs(n.x) < 0.999 ? math::Vec3{1.0, 0.0, 0.0} : math::Vec3{0.0, 1.0, 0.0};
    return math::normalized(along - math::dot(along, n) * n);
  }

  /// A ray that leaves the surface.
  math::Ray leaving(math::Point3 from_m, math::Vec3 direction) const {
    return {.origin_m = from_m, .direction = direction, .time_s = time_s};
  }

  Sides(const math::Ray& arriving, const geometry::SurfacePoint& hit, math::Normal3 shading_normal)
      : outgoing(-arriving.direction),
        time_s(arriving.time_s),
        outward((hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector()),
        shading(hit.front ? shading_normal : -shading_normal) {
    const math::Vec3 s = shading.as_vector();
    perturbed = s.x != outward.x || s.y != outward.y || s.z != outward.z;
    if (!perturbed) return;
    const double seen = math::dot(s, outgoing);
    if (seen < kLeastCosine) {
      const double along = std::max(1e-9, math::dot(outward, outgoing));
      shading = math::as_normal(math::normalized(s + (kLeastCosine - seen) / along * outward));
    }
  }
};

}  // namespace ifov::transport
