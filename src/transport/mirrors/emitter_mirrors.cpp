#include "transport/mirrors/emitter_mirrors.h"

#include <algorithm>
#include <cmath>

#include "geometry/world.h"
#include "geometry/world/surface_survey.h"
#include "scene/scene.h"

namespace ifov::transport {

namespace {

/// A point of a plane lies this near to it, in parts of its distance from the origin, and its normal this near to its own.
constexpr double kNear_m = 1e-4, kNear = 1e-9, kSameNormal = 1e-9;

}  // namespace

EmitterMirrors::EmitterMirrors(const scene::Scene& scene, const geometry::SurfaceSurvey& survey)
    : rounds_(scene, survey) {
  for (const scene::SurfaceAssignment& assignment : scene.assignments)
    bends_.push_back(assignment.bends_normals());
  for (const geometry::SurfaceSurvey::Flat& flat : survey.flats) {
    if (planes_.size() + flat.planes_m.size() > kMost || flat.many_planes) {
      planes_.clear();
      all_planes_ = false;
      return;
    }
    for (const double offset : flat.planes_m) planes_.push_back({flat.normal, offset});
  }
}

std::unique_ptr<const EmitterMirrors> EmitterMirrors::find(const scene::Scene& scene) {
  const geometry::SurfaceSurvey* survey = scene.world != nullptr ? scene.world->survey() : nullptr;
  if (survey == nullptr || scene.world->period()) return nullptr;
  std::unique_ptr<EmitterMirrors> mirrors(new EmitterMirrors(scene, *survey));
  if (mirrors->planes_.empty() && mirrors->rounds_.all().empty()) return nullptr;
  return mirrors;
}

bool EmitterMirrors::leave_some(const scene::Scene& scene) {
  const geometry::SurfaceSurvey* survey = scene.world != nullptr ? scene.world->survey() : nullptr;
  if (survey == nullptr || (survey->flats.empty() && survey->balls.empty() && survey->rounds.empty()))
    return false;
  const std::unique_ptr<const EmitterMirrors> mirrors = find(scene);
  if (mirrors == nullptr || !mirrors->all_planes_ || !survey->balls.empty() ||
      !mirrors->rounds_.unsought().empty() || mirrors->count() + mirrors->rounds_.all().size() > 1)
    return true;
  return std::find(mirrors->bends_.begin(), mirrors->bends_.end(), true) != mirrors->bends_.end();
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
