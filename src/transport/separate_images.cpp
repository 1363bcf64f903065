#include "transport/separate_images.h"

#include <algorithm>
#include <cmath>

#include "geometry/world.h"
#include "geometry/world/surface_survey.h"
#include "scene/scene.h"
#include "transport/shining_parts.h"

namespace ifov::transport {

namespace {

/// A point of a plane lies this near to it, in parts of its distance from the origin, and its normal this near to its own.
constexpr double kNear_m = 1e-4, kNear = 1e-9, kSameNormal = 1e-9;

}  // namespace

SeparateImages::SeparateImages(const scene::Scene& scene, const ShiningParts& parts) : parts_(parts) {
  const geometry::SurfaceSurvey* survey = scene.world != nullptr ? scene.world->survey() : nullptr;
  if (survey == nullptr || scene.world->period()) return;
  any_ = true;
  smooth_ = survey->all_flats && survey->flats.size() <= kMostNormals;
  for (const scene::SurfaceAssignment& assignment : scene.assignments)
    bends_.push_back(assignment.bends_normals());
  if (smooth_)
    for (const geometry::SurfaceSurvey::Flat& flat : survey->flats) normals_.push_back(flat.normal);
  std::size_t planes = 0;
  bool many = !survey->all_flats;
  for (const geometry::SurfaceSurvey::Flat& flat : survey->flats) {
    planes += flat.planes_m.size();
    many = many || flat.many_planes || planes > kMostPlanes;
  }
  if (many) return;
  for (const geometry::SurfaceSurvey::Flat& flat : survey->flats)
    for (const double offset : flat.planes_m) planes_.push_back({flat.normal, offset});
}

SeparateImages::Mirror SeparateImages::mirror_of(const geometry::SurfacePoint& hit, math::Vec3 normal) const {
  if (!any_ || hit.bend == geometry::Bend::field || bends_[hit.material]) return kNone;
  if (hit.bend == geometry::Bend::round) return curved(hit.instance);
  const auto along = [&](math::Vec3 other) { return 1.0 - std::abs(dot(other, normal)) < kSameNormal; };
  if (hit.bend == geometry::Bend::smooth) {
    if (!smooth_) return kNone;
    if (std::none_of(normals_.begin(), normals_.end(), along)) return curved(hit.instance);
  }
  const math::Vec3 at = hit.position_m - math::Point3{};
  for (std::size_t k = 0; k < planes_.size(); ++k)
    if (along(planes_[k].normal) &&
        std::abs(dot(planes_[k].normal, at) - planes_[k].offset_m) < kNear_m + kNear * length(at))
      return flat(k);
  return kNone;
}

void SeparateImages::finish() { std::sort(pairs_.begin(), pairs_.end()); }

bool SeparateImages::holds(Mirror mirror, const geometry::SurfacePoint& met) const {
  return mirror != kNone && met.hit() && parts_.shines(met) &&
         std::binary_search(pairs_.begin(), pairs_.end(), Pair{mirror, met.instance});
}

}  // namespace ifov::transport
