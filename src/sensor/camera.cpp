#include "sensor/camera.h"

#include <algorithm>
#include <cmath>

#include "radiometry/polarization_frame.h"
#include "sensor/along_track.h"

namespace ifov::sensor {

math::Transform GroundGrid::scene_from_image() const {
  const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
  return math::Transform::from_columns(gsd_m * math::Vec3{c, -s, 0.0}, gsd_m * math::Vec3{-s, -c, 0.0},
                                       {0.0, 0.0, 1.0}, upper_left_m);
}

math::Ray Camera::ray(const sampling::FocalPoint& point) const {
  math::Ray ray;
  rays({&point, 1}, {&ray, 1});
  return ray;
}

AlongTrack Camera::along_track() const { return {}; }

AlongTrack Camera::along_line() const { return {}; }

Ifov Camera::ifov(double line_px) const {
  const double middle = 0.5 * width_px();
  const auto angle = [&](const sampling::FocalPoint& from, const sampling::FocalPoint& to) {
    const math::Vec3 a = ray(from).direction, b = ray(to).direction;
    return std::atan2(math::length(math::cross(a, b)), math::dot(a, b));
  };
  return {angle({middle - 0.5, line_px}, {middle + 0.5, line_px}),
          angle({middle, line_px - 0.5}, {middle, line_px + 0.5})};
}

std::optional<double> Camera::line_gsd_m(double line_px, double ground_m) const {
  const math::Ray ray = middle_ray(line_px);
  const double below_m = ray.origin_m.z - ground_m;
  if (!(below_m >= 0.0) || !(ray.direction.z < 0.0)) return std::nullopt;
  return gsd_m(ray.origin_m + ray.direction * (below_m / -ray.direction.z));
}

std::vector<sampling::FocalPoint> grid_over(const Camera& camera, int columns, int rows, double margin_px) {
  std::vector<sampling::FocalPoint> points;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      points.push_back({(i + 0.5) / columns * (camera.width_px() + 2.0 * margin_px) - margin_px,
                        (j + 0.5) / rows * (camera.height_px() + 2.0 * margin_px) - margin_px});
  return points;
}

double nadir_angle_rad(const math::Ray& ray) { return std::acos(std::clamp(-ray.direction.z, -1.0, 1.0)); }

radiometry::PolarizationFrame focal_frame(const Camera& camera, const sampling::FocalPoint& point,
                                          const math::Ray& ray) {
  const CameraAxes axes = camera.axes_at(point);
  const math::Vec3 axis = -axes.forward;
  const math::Vec3 right = math::normalized(axes.right - math::dot(axes.right, axis) * axis);
  return radiometry::carried({axis, right}, -ray.direction);
}

}  // namespace ifov::sensor
