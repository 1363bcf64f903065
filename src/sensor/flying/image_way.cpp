#include "sensor/flying/image_way.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "sensor/camera.h"
#include "sensor/flying/flying_frame_camera.h"

namespace ifov::sensor {

std::optional<double> image_way_px(const FlyingFrameCamera& camera, math::Point3 place_m, double span_s) {
  constexpr double kSteps = 32.0, kMostSteps = 256.0;
  const int steps =
      static_cast<int>(std::clamp(std::ceil(4.0 * span_s / camera.step_s()), kSteps, kMostSteps));
  double way_px = 0.0;
  sampling::FocalPoint last, next;
  for (int k = 0; k <= steps; ++k) {
    if (!camera.project_when(place_m, span_s * (static_cast<double>(k) / steps - 0.5), next))
      return std::nullopt;
    if (k > 0) way_px += std::hypot(next.x_px - last.x_px, next.y_px - last.y_px);
    last = next;
  }
  return way_px;
}

std::optional<FrameMotion> frame_motion(const Camera& camera, double ground_m) {
  if (camera.flying() == nullptr) return std::nullopt;
  FrameMotion motion;
  bool any = false;
  for (const sampling::FocalPoint& point : grid_over(camera, 3, 3)) {
    const math::Ray ray = camera.ray(point);
    const double below_m = ray.origin_m.z - ground_m;
    if (!(below_m > 0.0) || !(ray.direction.z < 0.0)) continue;
    const math::Point3 place_m = ray.origin_m + ray.direction * (below_m / -ray.direction.z);
    // Of one row, so that which one it is makes no difference.
    std::unique_ptr<const Camera> row;
    if (camera.pictures() != nullptr) row = camera.pictures()->picture(static_cast<int>(point.y_px));
    const FlyingFrameCamera& at = row ? *row->flying() : *camera.flying();
    const auto exposed = image_way_px(at, place_m, camera.exposure_s()),
               next = image_way_px(at, place_m, camera.row_period_s());
    if (!exposed || !next) continue;
    any = true;
    motion = {std::max(motion.exposure_px, *exposed), std::max(motion.row_px, *next)};
  }
  return any ? std::optional(motion) : std::nullopt;
}

}  // namespace ifov::sensor
