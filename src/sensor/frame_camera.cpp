#include "sensor/frame_camera.h"

#include <cmath>

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
}

void FrameCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    rays[i] = {
        .origin_m = settings_.position_m,
        .direction = math::normalized(first_ + right_step_ * points[i].x_px + down_step_ * points[i].y_px),
        .time_s = points[i].time_s + row_time_s(points[i].y_px)};
}

bool FrameCamera::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const math::Vec3 offset = position_m - settings_.position_m;
  const double depth = math::dot(offset, settings_.axes.forward);
  if (!(depth > 0.0)) return false;
  const double scale = settings_.focal_length_m / (settings_.pitch_m * depth);
  point = {0.5 * settings_.width_px + math::dot(offset, settings_.axes.right) * scale,
           0.5 * settings_.height_px + math::dot(offset, settings_.axes.down) * scale};
  return true;
}

double FrameCamera::gsd_m(math::Point3 position_m) const {
  const double depth = math::dot(position_m - settings_.position_m, settings_.axes.forward);
  return std::abs(depth) * settings_.pitch_m / settings_.focal_length_m;
}

}  // namespace ifov::sensor
