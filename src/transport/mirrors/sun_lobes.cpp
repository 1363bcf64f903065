#include "transport/mirrors/sun_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world/surface_survey.h"
#include "materials/bsdf/narrow_lobes.h"
#include "scene/scene.h"
#include "transport/mirrors/lobe_targets.h"
#include "transport/mirrors/sun_mirrors.h"

namespace ifov::transport {

namespace {

/// Between the widest and the narrowest of what is found.
double middle_slope(const scene::Scene& scene) {
  double least = 1.0, most = materials::kLeastFoundSlope;
  for (const materials::Material& material : scene.materials) {
    if (!materials::has_narrow_lobe(*material.bsdf)) continue;
    least = std::min(least, material.bsdf->lobe_slopes().least);
    most = std::max(most, material.bsdf->lobe_slopes().most);
  }
  return std::sqrt(std::max(least, materials::kLeastFoundSlope) * most);
}

}  // namespace

SunLobes::SunLobes(const scene::Scene& scene, const geometry::SurfaceSurvey& survey)
    : survey_(survey),
      targets_(std::make_unique<const LobeTargets>(survey, scene.sun->direction, middle_slope(scene))) {
  for (const scene::SurfaceAssignment& assignment : scene.assignments)
    tilted_.push_back(assignment.bends_normals());
  for (const bool tilted : tilted_) flat_.push_back(!scene.world->period() && !tilted);
  for (const auto& round : survey.rounds) rounds_.push_back(round.object);
  std::sort(rounds_.begin(), rounds_.end());
  for (const materials::Material& material : scene.materials) {
    if (!materials::has_narrow_lobe(*material.bsdf)) continue;
    const materials::Bsdf::LobeSlopes slopes = material.bsdf->lobe_slopes();
    slopes_.least = slopes_.least > 0.0 ? std::min(slopes_.least, slopes.least) : slopes.least;
    slopes_.most = std::max(slopes_.most, slopes.most);
    if (material.bsdf->lobe_is_all()) seen_reach_rad_ = std::numbers::pi;
    any_throws_rarely_ = any_throws_rarely_ || materials::throws_rarely(*material.bsdf);
  }
  seen_reach_rad_ = std::max(
      seen_reach_rad_,
      std::min(std::numbers::pi, 2.0 * std::atan(kLastSlopes * slopes_.most) + scene.sun->half_angle_rad));
  if (!any_throws_rarely_) return;
  std::vector<geometry::SurfaceSurvey::Ball> balls = survey.balls;
  for (const auto& face : survey.faces) balls.push_back(face.ball);
  for (const auto& round : survey.rounds) balls.push_back(round.ball);
  throwers_ = SunMirrors::grouped(std::move(balls));
}

SunLobes::~SunLobes() = default;

bool SunLobes::by_shape(const geometry::SurfacePoint& hit) const {
  if (!flat_[hit.material]) return false;
  if (hit.bend == geometry::Bend::round)
    return std::binary_search(rounds_.begin(), rounds_.end(), hit.instance);
  return survey_.all_facets && (hit.bend == geometry::Bend::smooth || hit.bend == geometry::Bend::facet);
}

bool SunLobes::sought(const materials::Bsdf& bsdf) const {
  return !targets_->empty() && materials::has_narrow_lobe(bsdf);
}

double SunLobes::share(const materials::Bsdf& bsdf, const materials::BsdfEvent& event) {
  if (event.side != materials::Side::reflected || !materials::has_narrow_lobe(bsdf)) return 0.0;
  const math::Vec3 half = event.outgoing + event.incoming;
  const double along = math::dot(event.normal, half);
  if (along <= 0.0) return 0.0;
  const double across = std::sqrt(std::max(0.0, math::dot(half, half) - along * along));
  const double slopes = across / along / bsdf.lobe_slopes().most;
  if (slopes >= kLastSlopes) return 0.0;
  const double t = std::clamp((kLastSlopes - slopes) / (kLastSlopes - kFirstSlopes), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t) * bsdf.lobe_share(event);
}

double SunLobes::seen_share(const materials::Bsdf& bsdf, const materials::BsdfEvent& event) {
  if (bsdf.lobe_is_all() && materials::has_narrow_lobe(bsdf))
    return event.side == materials::Side::reflected ? 1.0 : 0.0;
  return share(bsdf, event);
}

}  // namespace ifov::transport
