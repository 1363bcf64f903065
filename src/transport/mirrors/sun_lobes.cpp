#include "transport/mirrors/sun_lobes.h"

#include <algorithm>
#include <cmath>

#include "geometry/world/surface_survey.h"
#include "materials/bsdf/narrow_lobes.h"
#include "scene/scene.h"
#include "transport/mirrors/sun_mirrors.h"

namespace ifov::transport {

SunLobes::SunLobes(const scene::Scene& scene, const geometry::SurfaceSurvey& survey) : survey_(survey) {
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
    any_throws_rarely_ = any_throws_rarely_ || materials::throws_rarely(*material.bsdf);
  }
  if (!any_throws_rarely_) return;
  std::vector<geometry::SurfaceSurvey::Ball> balls = survey.balls;
  for (const auto& round : survey.rounds) balls.push_back(round.ball);
  throwers_ = SunMirrors::grouped(std::move(balls));
}

bool SunLobes::by_shape(const geometry::SurfacePoint& hit) const {
  if (!flat_[hit.material]) return false;
  if (hit.bend == geometry::Bend::round)
    return std::binary_search(rounds_.begin(), rounds_.end(), hit.instance);
  return survey_.all_facets && (hit.bend == geometry::Bend::smooth || hit.bend == geometry::Bend::facet);
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

}  // namespace ifov::transport
