#include "sensor/orthographic_camera.h"

#include <cmath>

#include "core/error.h"

namespace ifov::sensor {

OrthographicCamera::OrthographicCamera(const Settings& settings) : settings_(settings) {
  if (settings.width_px < 1 || settings.height_px < 1)
    throw InputError(
        format("an image of {} x {} pixels; expected at least 1 x 1", settings.width_px, settings.height_px));
  if (!(settings.gsd_m > 0.0) || !std::isfinite(settings.gsd_m))
    throw InputError(format("a ground sample distance of {} m; expected a positive length", settings.gsd_m));
  for (const double value :
       {settings.centre_x_m, settings.centre_y_m, settings.rotation_rad, settings.start_height_m})
    if (!std::isfinite(value)) throw InputError("the orthographic camera's placement is not a finite number");

  const double c = std::cos(settings.rotation_rad), s = std::sin(settings.rotation_rad);
  right_m_ = settings.gsd_m * math::Vec3{c, -s, 0.0};
  down_m_ = settings.gsd_m * math::Vec3{-s, -c, 0.0};
  corner_ = math::Point3{settings.centre_x_m, settings.centre_y_m, settings.start_height_m} -
            right_m_ * (0.5 * settings.width_px) - down_m_ * (0.5 * settings.height_px);
}

void OrthographicCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    rays[i] = {corner_ + right_m_ * points[i].x_px + down_m_ * points[i].y_px, {0.0, 0.0, -1.0}};
}

bool OrthographicCamera::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const math::Vec3 offset = position_m - corner_;
  const double per_area = 1.0 / (settings_.gsd_m * settings_.gsd_m);
  point = {math::dot(offset, right_m_) * per_area, math::dot(offset, down_m_) * per_area};
  return position_m.z <= settings_.start_height_m;
}

}  // namespace ifov::sensor
