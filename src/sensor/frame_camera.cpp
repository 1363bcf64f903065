#include "sensor/frame_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace ifov::sensor {

FrameCamera::FrameCamera(const Settings& settings) : settings_(settings) {
  if (settings.width_px < 1 || settings.height_px < 1)
    throw InputError(
        format("an image of {} x {} pixels; expected at least 1 x 1", settings.width_px, settings.height_px));
  if (!(settings.focal_length_m > 0.0) || !std::isfinite(settings.focal_length_m))
    throw InputError(format("a focal length of {} m; expected a positive length", settings.focal_length_m));
  if (!(settings.pitch_m > 0.0) || !std::isfinite(settings.pitch_m))
    throw InputError(format("a detector pitch of {} m; expected a positive length", settings.pitch_m));
  const math::Point3 p = settings.position_m;
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
    throw InputError("the frame camera's position is not finite");

  if (!(settings.exposure_s >= 0.0) || !(settings.row_period_s >= 0.0) ||
      !std::isfinite(settings.exposure_s) || !std::isfinite(settings.row_period_s))
    throw InputError(format("an exposure of {} s and rows {} s apart; expected 0 s or more",
                            settings.exposure_s, settings.row_period_s));

  const double step = settings.pitch_m / settings.focal_length_m;
  right_step_ = settings.axes.right * step;
  down_step_ = settings.axes.down * step;
  first_ = settings.axes.forward - right_step_ * (0.5 * settings.width_px) -
           down_step_ * (0.5 * settings.height_px);
  check_folds();
}

void FrameCamera::check_folds() const {
  if (!settings_.lens) return;
  // Outwards from the middle, so that the first pixel that is told is the one where it begins.
  constexpr int kSteps = 64;
  const double w = settings_.width_px, h = settings_.height_px;
  for (int k = 1; k <= kSteps; ++k) {
    const double share = static_cast<double>(k) / kSteps, left = 0.5 * w * (1.0 - share),
                 top = 0.5 * h * (1.0 - share);
    for (int a = 0; a <= kSteps; ++a) {
      const double along = static_cast<double>(a) / kSteps;
      const double x = left + along * share * w, y = top + along * share * h;
      for (const auto& [px, py] :
           {std::pair{x, top}, std::pair{x, h - top}, std::pair{left, y}, std::pair{w - left, y}})
        if (!settings_.lens->holds(beside(px, py)))
          throw InputError(format(
              "the lens distortion folds back within the frame: no direction has its image at pixel {:.0f}, {:.0f} (column, row) and "
              "beyond; expected terms that go on rising to the corners",
              std::min(px, w - 1.0), std::min(py, h - 1.0)));
    }
  }
}

void FrameCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  const auto direction = [&](const sampling::FocalPoint& point) {
    if (!settings_.lens) return first_ + right_step_ * point.x_px + down_step_ * point.y_px;
    const Lens::Place there = settings_.lens->direction_of(beside(point.x_px, point.y_px));
    return settings_.axes.forward + settings_.axes.right * there.x + settings_.axes.down * there.y;
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    rays[i] = {.origin_m = settings_.position_m,
               .direction = math::normalized(direction(points[i])),
               .time_s = points[i].time_s + row_time_s(points[i].y_px)};
}

bool FrameCamera::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const math::Vec3 offset = position_m - settings_.position_m;
  const double depth = math::dot(offset, settings_.axes.forward);
  if (!(depth > 0.0)) return false;
  if (settings_.lens) {
    const Lens::Place there = settings_.lens->image_of(
        {math::dot(offset, settings_.axes.right) / depth, math::dot(offset, settings_.axes.down) / depth});
    const double pixels = settings_.focal_length_m / settings_.pitch_m;
    point = {0.5 * settings_.width_px + there.x * pixels, 0.5 * settings_.height_px + there.y * pixels};
    return true;
  }
  const double scale = settings_.focal_length_m / (settings_.pitch_m * depth);
  point = {0.5 * settings_.width_px + math::dot(offset, settings_.axes.right) * scale,
           0.5 * settings_.height_px + math::dot(offset, settings_.axes.down) * scale};
  return true;
}

double FrameCamera::gsd_m(math::Point3 position_m) const {
  const double depth = math::dot(position_m - settings_.position_m, settings_.axes.forward);
  const double plain = std::abs(depth) * settings_.pitch_m / settings_.focal_length_m;
  if (!settings_.lens || depth == 0.0) return plain;
  const math::Vec3 offset = position_m - settings_.position_m;
  return plain / std::sqrt(settings_.lens->scale({math::dot(offset, settings_.axes.right) / depth,
                                                  math::dot(offset, settings_.axes.down) / depth}));
}

}  // namespace ifov::sensor
