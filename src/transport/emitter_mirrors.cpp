#include "transport/emitter_mirrors.h"

#include <algorithm>
#include <cmath>

#include "geometry/world.h"
#include "geometry/world/surface_survey.h"

namespace ifov::transport {

namespace {

/// A point of a plane lies this near to it, in parts of its distance from the origin, and its normal this near to its own.
constexpr double kNear_m = 1e-4, kNear = 1e-9, kSameNormal = 1e-9;

}  // namespace

std::unique_ptr<const EmitterMirrors> EmitterMirrors::find(const scene::Scene& scene) {
  const geometry::SurfaceSurvey* survey = scene.world != nullptr ? scene.world->survey() : nullptr;
  if (survey == nullptr || survey->flats.empty() || scene.world->period()) return nullptr;
  auto mirrors = std::make_unique<EmitterMirrors>();
  for (const scene::Covering& covering : scene.coverings) mirrors->bends_.push_back(covering.bends_normals());
  for (const geometry::SurfaceSurvey::Flat& flat : survey->flats) {
    if (mirrors->planes_.size() + flat.planes_m.size() > kMost || flat.many_planes) return nullptr;
    for (const double offset : flat.planes_m) mirrors->planes_.push_back({flat.normal, offset});
  }
  return mirrors->planes_.empty() ? nullptr : std::move(mirrors);
}

bool EmitterMirrors::leave_some(const scene::Scene& scene) {
  const geometry::SurfaceSurvey* survey = scene.world != nullptr ? scene.world->survey() : nullptr;
  if (survey == nullptr || (survey->flats.empty() && survey->balls.empty() && survey->rounds.empty()))
    return false;
  const std::unique_ptr<const EmitterMirrors> planes = find(scene);
  if (planes == nullptr || planes->count() > 1 || !survey->balls.empty() || !survey->rounds.empty())
    return true;
  return std::find(planes->bends_.begin(), planes->bends_.end(), true) != planes->bends_.end();
}

std::uint32_t EmitterMirrors::plane_of(const geometry::SurfacePoint& hit,
                                       math::Vec3 reflecting_normal) const {
  if (hit.bend == geometry::Bend::round || hit.bend == geometry::Bend::field || bends_[hit.material])
    return kNone;
  const math::Vec3 at = hit.position_m - math::Point3{};
  for (std::uint32_t k = 0; k < planes_.size(); ++k)
    if (1.0 - std::abs(dot(planes_[k].normal, reflecting_normal)) < kSameNormal &&
        std::abs(dot(planes_[k].normal, at) - planes_[k].offset_m) < kNear_m + kNear * length(at))
      return k;
  return kNone;
}

Receiver EmitterMirrors::behind(std::uint32_t plane, const Receiver& receiver) const {
  const Plane& p = planes_[plane];
  const double above = dot(p.normal, receiver.at_m - math::Point3{}) - p.offset_m;
  return {receiver.at_m - 2.0 * above * p.normal, mirrored(plane, receiver.normal)};
}

math::Vec3 EmitterMirrors::mirrored(std::uint32_t plane, math::Vec3 direction) const {
  const math::Vec3 n = planes_[plane].normal;
  return direction - 2.0 * dot(direction, n) * n;
}

}  // namespace ifov::transport
