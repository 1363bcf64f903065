#include "render/moving/moving_cover.h"

#include "geometry/motion/moving_world.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::render {
namespace {

/// The dimension pair of a path's time, beyond those of all that paths do.
constexpr std::uint32_t kTimePair = 1u << 20;

}  // namespace

std::unique_ptr<const MovingCover> MovingCover::find(const scene::Scene& scene,
                                                     const sensor::Camera& camera) {
  const geometry::MovingWorld* moving = scene.world != nullptr ? scene.world->moving() : nullptr;
  if (moving == nullptr || !(camera.exposure_s() > 0.0 || camera.row_period_s() > 0.0)) return nullptr;
  return std::unique_ptr<const MovingCover>(
      new MovingCover(*moving, camera.exposure_s(), camera.row_period_s()));
}

double MovingCover::time_s(const sampling::PathRequest& request) const {
  return (sampling::sequence_point(request.sequence, request.index, kTimePair).x - 0.5) * exposure_s_;
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
