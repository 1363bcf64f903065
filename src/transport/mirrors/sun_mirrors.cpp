#include "transport/mirrors/sun_mirrors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "scene/scene.h"

namespace ifov::transport {

namespace {

using geometry::SurfaceSurvey;
using math::Point3;
using math::Vec3;

/// Faces whose planes differ by less than this count as one.
constexpr double kSamePlane_m = 1e-3;

SurfaceSurvey::Ball around(const SurfaceSurvey::Ball& a, const SurfaceSurvey::Ball& b) {
  const Vec3 between = b.centre_m - a.centre_m;
  const double apart = length(between);
  if (apart + b.radius_m <= a.radius_m) return a;
  if (apart + a.radius_m <= b.radius_m) return b;
  const double radius = 0.5 * (apart + a.radius_m + b.radius_m);
  return {a.centre_m + between * ((radius - a.radius_m) / apart), radius};
}

/// Halves of a list of balls along its longest side, until few enough are left.
void group(std::span<SurfaceSurvey::Ball> balls, std::size_t groups, std::vector<SurfaceSurvey::Ball>& out) {
  if (balls.empty()) return;
  if (groups <= 1 || balls.size() == 1) {
    out.push_back(std::accumulate(balls.begin() + 1, balls.end(), balls.front(), around));
    return;
  }
  const auto coordinate = [](const SurfaceSurvey::Ball& ball, int axis) {
    return axis == 0 ? ball.centre_m.x : axis == 1 ? ball.centre_m.y : ball.centre_m.z;
  };
  int longest = 0;
  double side = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    double low = coordinate(balls.front(), axis), high = low;
    for (const auto& ball : balls) {
      low = std::min(low, coordinate(ball, axis));
      high = std::max(high, coordinate(ball, axis));
    }
    if (high - low > side) side = high - low, longest = axis;
  }
  const auto middle = balls.size() / 2;
  std::nth_element(
      balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(middle), balls.end(),
      [&](const auto& a, const auto& b) { return coordinate(a, longest) < coordinate(b, longest); });
  group(balls.first(middle), groups / 2, out);
  group(balls.subspan(middle), groups - groups / 2, out);
}

}  // namespace

SunMirrors::SunMirrors(const scene::Scene& scene, const SurfaceSurvey& survey)
    : survey_(survey), rounds_(scene, survey) {
  for (const scene::SurfaceAssignment& assignment : scene.assignments)
    bends_.push_back(assignment.bends_normals());
  std::vector<std::size_t> order(survey.flats.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t kept = std::min(order.size(), kMostFacings);
  by_shape_ = !scene.world->period() && survey.all_flats && kept == order.size();
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return survey.flats[a].area_m2 > survey.flats[b].area_m2;
  });
  std::vector<SurfaceSurvey::Ball> balls = survey.balls;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const SurfaceSurvey::Flat& flat = survey.flats[order[k]];
    if (k < kept)
      facings_.push_back({flat.normal, flat.bounds, flat.high_m - flat.low_m < kSamePlane_m});
    else
      balls.push_back({flat.bounds.low_m + (flat.bounds.high_m - flat.bounds.low_m) * 0.5,
                       0.5 * length(flat.bounds.high_m - flat.bounds.low_m)});
  }
  // A relief bends what is flat.
  if (std::find(bends_.begin(), bends_.end(), true) != bends_.end() && !facings_.empty())
    for (const Facing& facing : facings_)
      balls.push_back({facing.bounds.low_m + (facing.bounds.high_m - facing.bounds.low_m) * 0.5,
                       0.5 * length(facing.bounds.high_m - facing.bounds.low_m)});
  balls.insert(balls.end(), rounds_.unsought().begin(), rounds_.unsought().end());
  // What a ball reflects is sought, not what it refracts.
  refracts_ = std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& material) {
    return material.bsdf->passage() == materials::Passage::into;
  });
  if (refracts_)
    for (const SurfaceSurvey::Round& round : survey.rounds) balls.push_back(round.ball);
  groups_ = grouped(std::move(balls));
}

std::vector<SurfaceSurvey::Ball> SunMirrors::grouped(std::vector<SurfaceSurvey::Ball> balls) {
  std::vector<SurfaceSurvey::Ball> groups;
  group(balls, kMostGroups, groups);
  return groups;
}

std::uint32_t SunMirrors::facing_of(const geometry::SurfacePoint& hit, Vec3 normal) const {
  if (hit.bend == geometry::Bend::round || hit.bend == geometry::Bend::field || bends_[hit.material])
    return kNone;
  std::uint32_t nearest = kNone;
  double along = 1.0 - 2.0 * SurfaceSurvey::kSameNormal_rad * SurfaceSurvey::kSameNormal_rad;
  for (std::uint32_t k = 0; k < facings_.size(); ++k) {
    const double here = std::abs(dot(facings_[k].normal, normal));
    if (here > along) along = here, nearest = k;
  }
  return nearest;
}

bool may_meet(const geometry::World::Bounds& box, Point3 from, Vec3 direction, double slope) {
  const Vec3 half = (box.high_m - box.low_m) * 0.5;
  const double pad = 1e-9 + slope * (length(box.low_m + half - from) + length(half));
  double enter = 0.0, leave = 1e300;
  const double low[3] = {box.low_m.x, box.low_m.y, box.low_m.z},
               high[3] = {box.high_m.x, box.high_m.y, box.high_m.z};
  const double at[3] = {from.x, from.y, from.z}, along[3] = {direction.x, direction.y, direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / (along[axis] == 0.0 ? 1e-300 : along[axis]);
    const double a = (low[axis] - pad - at[axis]) * inverse, b = (high[axis] + pad - at[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

}  // namespace ifov::transport
