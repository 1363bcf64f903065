#include "transport/mirrors/mirror_paths.h"

#include <algorithm>

namespace ifov::transport {

bool reflect(MirrorPath& way, const SunMirrors& mirrors, const geometry::SurfacePoint& hit,
             const scene::ResolvedSurface& surface) {
  math::Vec3 next = way.towards_sun;
  if (way.image == MirrorPath::kRound) {
    // The first reflection must be that which was meant: a ray that misses it is hidden or past an edge.
    if (way.count > 0 || hit.instance != way.object || !mirrors.rounds().sought(hit) || !is_at(hit, way.at))
      return false;
  } else {
    const math::Vec3 normal = surface.shading_normal.as_vector();
    const std::uint32_t facing = mirrors.facing_of(hit, normal);
    if (facing == SunMirrors::kNone || way.count >= way.facings.size()) return false;
    way.facings[way.count] = static_cast<std::uint16_t>(facing);
    next = math::normalized(way.ray.direction - 2.0 * math::dot(way.ray.direction, normal) * normal);
  }
  const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
  if (!(math::dot(next, outward) > 0.0)) return false;
  ++way.count;
  way.ray = way.ray.onward(hit.position_m + hit.offset_m * outward, next);
  return true;
}

bool MirrorTracer::mirrors_at(const scene::ResolvedSurface& surface) const {
  return std::any_of(surface.begin(), surface.end(),
                     [&](const scene::Constituent& part) { return is_mirror(scene_, part); });
}

bool MirrorTracer::is_image(const MirrorPath& way) const {
  return way.image == MirrorPath::kRound ? way.count > 0
                                         : images_.image_of({way.facings.data(), way.count}) == way.image;
}

}  // namespace ifov::transport
