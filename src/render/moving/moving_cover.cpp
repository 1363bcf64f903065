#include "render/moving/moving_cover.h"

#include <algorithm>
#include <vector>

#include "geometry/motion/moving_world.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::render {
namespace {

/// The dimension pair of a path's time, beyond those of all that paths do.
constexpr std::uint32_t kTimePair = 1u << 20;

}  // namespace

MovingCover::MovingCover(const scene::Scene& scene, double exposure_s, double beyond_s)
    : scene_(scene), world_(*scene.world->moving()), exposure_s_(exposure_s), beyond_s_(beyond_s) {}

std::unique_ptr<MovingCover> MovingCover::find(const scene::Scene& scene, const sensor::Camera& camera) {
  const geometry::MovingWorld* moving = scene.world != nullptr ? scene.world->moving() : nullptr;
  if (moving == nullptr || camera.moves_while_exposed() ||
      !(camera.exposure_s() > 0.0 || camera.row_period_s() > 0.0))
    return nullptr;
  return std::unique_ptr<MovingCover>(new MovingCover(scene, camera.exposure_s(), camera.row_period_s()));
}

const geometry::World& MovingCover::still() const { return world_.still(); }

void MovingCover::meet_still(std::span<const math::Ray> rays, std::span<geometry::SurfacePoint> hits) const {
  world_.still().intersect(rays, hits);
}

MovingCover::Times MovingCover::times(const sampling::PathRequest& request, const math::Ray& ray,
                                      const geometry::SurfacePoint& first, std::span<const math::Ray> ways,
                                      const geometry::SurfacePoint& last) {
  if (!(exposure_s_ > 0.0)) return {};
  const double from_s = ray.time_s - 0.5 * exposure_s_, to_s = ray.time_s + 0.5 * exposure_s_;
  static thread_local std::vector<geometry::TimeInterval> met_times;  // kept for its memory
  met_times.clear();
  math::Ray seen = ray;
  if (first.hit()) seen.t_max_m = first.distance_m;
  world_.when_met(seen, from_s, to_s, 0.0, met_times);
  for (const math::Ray& way : ways) world_.when_met(way, from_s, to_s, 0.0, met_times);
  if (last.hit() && scene_.sun && scene_.sun->is_up()) {
    const math::Vec3 normal = last.geometric_normal.as_vector(), sun = scene_.sun->direction;
    const math::Vec3 outward = math::dot(normal, sun) < 0.0 ? -normal : normal;
    world_.when_met(ray.onward(last.position_m + last.offset_m * outward, sun), from_s, to_s,
                    scene_.sun->half_angle_rad, met_times);
  }
  Times times = drawn(met_times, from_s, to_s, request);
  times.met_s -= ray.time_s, times.else_s -= ray.time_s;
  return times;
}

MovingCover::Times MovingCover::drawn(std::vector<geometry::TimeInterval>& met_times, double from_s,
                                      double to_s, const sampling::PathRequest& request) {
  // In order, without overlap, within that time.
  std::sort(met_times.begin(), met_times.end(),
            [](const auto& a, const auto& b) { return a.from_s < b.from_s; });
  std::size_t count = 0;
  double last_s = from_s, met = 0.0;
  for (const auto& one : met_times) {
    const double begin_s = std::max(one.from_s, last_s), end_s = std::min(one.to_s, to_s);
    if (!(end_s > begin_s)) continue;
    met_times[count++] = {begin_s, end_s};
    met += end_s - begin_s;
    last_s = end_s;
  }
  met_times.resize(count);
  const sampling::Point2 u = sampling::sequence_point(request.sequence, request.index, kTimePair);
  Times times;
  times.share = std::clamp(met / (to_s - from_s), 0.0, 1.0);
  // The time up to which so much of those intervals, or of what is between them, has passed.
  double met_left = u.x * met, else_left = u.y * ((to_s - from_s) - met), at_s = from_s;
  bool met_found = false, else_found = false;
  for (const auto& one : met_times) {
    if (!else_found && else_left <= one.from_s - at_s) times.else_s = at_s + else_left, else_found = true;
    else_left -= one.from_s - at_s;
    if (!met_found && met_left <= one.to_s - one.from_s)
      times.met_s = one.from_s + met_left, met_found = true;
    met_left -= one.to_s - one.from_s;
    at_s = one.to_s;
  }
  if (!else_found) times.else_s = std::min(at_s + else_left, to_s);
  if (!met_found) times.met_s = at_s;
  return times;
}

bool MovingCover::covers(const sampling::FocalPoint& point, const math::Ray& ray,
                         const geometry::SurfacePoint& met) const {
  if (met.hit() && world_.is_moving(met.instance)) return true;
  // What stands still hides what is behind it at all times.
  math::Ray seen = ray;
  if (met.hit()) seen.t_max_m = met.distance_m;
  return shades(point, ray, seen, 0.0);
}

bool MovingCover::shades(const sampling::FocalPoint& point, const math::Ray& seen, const math::Ray& towards,
                         double spread_rad) const {
  const double middle_s = seen.time_s - point.time_s, half_s = 0.5 * exposure_s_ + beyond_s_;
  return world_.may_move_into(towards, middle_s - half_s, middle_s + half_s, spread_rad);
}

}  // namespace ifov::render
