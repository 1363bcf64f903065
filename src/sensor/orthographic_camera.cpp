#include "sensor/orthographic_camera.h"

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::sensor {

OrthographicCamera::OrthographicCamera(const Settings& settings) : settings_(settings) {
  if (settings.width_px < 1 || settings.height_px < 1)
    throw InputError(
        format("an image of {} x {} pixels; expected at least 1 x 1", settings.width_px, settings.height_px));
  if (!(settings.gsd_m > 0.0) || !std::isfinite(settings.gsd_m))
    throw InputError(format("a ground sample distance of {} m; expected a positive length", settings.gsd_m));
  for (const double value : {settings.centre_x_m, settings.centre_y_m, settings.rotation_rad,
                             settings.start_height_m, settings.view_azimuth_rad})
    if (!std::isfinite(value)) throw InputError("the orthographic camera's placement is not a finite number");

  if (!(settings.view_zenith_rad >= 0.0) || !(settings.view_zenith_rad < 0.5 * std::numbers::pi))
    throw InputError(format("a view zenith angle of {:g} degrees; expected at least 0 and less than 90",
                            settings.view_zenith_rad * 180.0 / std::numbers::pi));

  const double tilt = std::sin(settings.view_zenith_rad);
  towards_sensor_ = {tilt * std::sin(settings.view_azimuth_rad), tilt * std::cos(settings.view_azimuth_rad),
                     std::cos(settings.view_zenith_rad)};
  const math::Transform turned = GroundGrid{{}, settings.gsd_m, settings.rotation_rad}.scene_from_image();
  right_m_ = turned.column_x();
  down_m_ = turned.column_y();
  corner_ = math::Point3{settings.centre_x_m, settings.centre_y_m, 0.0} -
            right_m_ * (0.5 * settings.width_px) - down_m_ * (0.5 * settings.height_px);
}

void OrthographicCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  const math::Point3 start = corner_ + towards_sensor_ * (settings_.start_height_m / towards_sensor_.z);
  for (std::size_t i = 0; i < points.size(); ++i)
    rays[i] = {.origin_m = start + right_m_ * points[i].x_px + down_m_ * points[i].y_px,
               .direction = math::Vec3{} - towards_sensor_,
               .time_s = points[i].time_s};
}

bool OrthographicCamera::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const math::Vec3 offset = position_m - towards_sensor_ * (position_m.z / towards_sensor_.z) - corner_;
  const double per_area = 1.0 / (settings_.gsd_m * settings_.gsd_m);
  point = {math::dot(offset, right_m_) * per_area, math::dot(offset, down_m_) * per_area};
  return position_m.z <= settings_.start_height_m;
}

CameraPose OrthographicCamera::pose(double) const {
  const double c = std::cos(settings_.rotation_rad), s = std::sin(settings_.rotation_rad);
  CameraPose pose;
  pose.axes = {{c, -s, 0.0}, {-s, -c, 0.0}, -towards_sensor_};
  return pose;
}

}  // namespace ifov::sensor
