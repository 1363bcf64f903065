#include "sensor/single_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "sampling/warp.h"

namespace ifov::sensor {
namespace {

/// Image x and y of a view along an axis: any two across it.
CameraAxes axes_along(math::Vec3 forward) {
  const math::Vec3 any = std::abs(forward.z) < 0.9 ? math::Vec3{0.0, 0.0, 1.0} : math::Vec3{0.0, 1.0, 0.0};
  const math::Vec3 right = math::normalized(math::cross(forward, any));
  return {right, math::cross(forward, right), forward};
}

void require_finite(std::initializer_list<double> values, const char* what) {
  for (const double value : values)
    if (!std::isfinite(value)) throw InputError(format("{} is not a finite number", what));
}

}  // namespace

AreaView::AreaView(const Settings& s) : settings_(s) {
  require_finite({s.centre_x_m, s.centre_y_m, s.height_m, s.azimuth_rad, s.start_height_m},
                 "the place of an area");
  if (!(s.width_m > 0.0) || !(s.depth_m > 0.0) || !std::isfinite(s.width_m * s.depth_m))
    throw InputError(format("an area of {:g} x {:g} m; expected positive lengths", s.width_m, s.depth_m));
  if (!(s.zenith_rad >= 0.0) || !(s.zenith_rad < 0.5 * std::numbers::pi))
    throw InputError(format("a view zenith angle of {:g} degrees; expected at least 0 and less than 90",
                            s.zenith_rad * 180.0 / std::numbers::pi));
  const double tilt = std::sin(s.zenith_rad);
  towards_sensor_ = {tilt * std::sin(s.azimuth_rad), tilt * std::cos(s.azimuth_rad), std::cos(s.zenith_rad)};
  corner_ = {s.centre_x_m - 0.5 * s.width_m, s.centre_y_m + 0.5 * s.depth_m, s.height_m};
}

void AreaView::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  const math::Point3 start =
      corner_ + towards_sensor_ * ((settings_.start_height_m - settings_.height_m) / towards_sensor_.z);
  for (std::size_t i = 0; i < points.size(); ++i)
    rays[i] = {.origin_m = start + math::Vec3{settings_.width_m * points[i].x_px,
                                              -settings_.depth_m * points[i].y_px, 0.0},
               .direction = -towards_sensor_,
               .time_s = points[i].time_s};
}

bool AreaView::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const math::Vec3 offset =
      position_m - towards_sensor_ * ((position_m.z - settings_.height_m) / towards_sensor_.z) - corner_;
  point = {offset.x / settings_.width_m, -offset.y / settings_.depth_m};
  return position_m.z <= settings_.start_height_m;
}

double AreaView::gsd_m(math::Point3) const { return std::sqrt(settings_.width_m * settings_.depth_m); }

CameraPose AreaView::pose(double) const {
  CameraPose pose;
  pose.axes = {{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, -towards_sensor_};
  return pose;
}

HemisphereView::HemisphereView(math::Point3 position_m, math::Vec3 normal)
    : origin_m_(position_m + kOff_m * normal), axes_(axes_along(normal)) {
  require_finite({position_m.x, position_m.y, position_m.z, normal.x, normal.y, normal.z}, "a point");
}

void HemisphereView::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  constexpr double kMost = 1.0 - 1e-12;  // beyond the disc, and so the pixel: along the plane
  for (std::size_t i = 0; i < points.size(); ++i) {
    sampling::Point2 disc = sampling::uniform_disk({points[i].x_px, points[i].y_px});
    double squared = disc.x * disc.x + disc.y * disc.y;
    if (squared > kMost) {
      const double scale = std::sqrt(kMost / squared);
      disc = {scale * disc.x, scale * disc.y}, squared = kMost;
    }
    rays[i] = {.origin_m = origin_m_,
               .direction = math::normalized(disc.x * axes_.right + disc.y * axes_.down +
                                             std::sqrt(1.0 - squared) * axes_.forward),
               .time_s = points[i].time_s};
  }
}

bool HemisphereView::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const math::Vec3 offset = position_m - origin_m_;
  const double distance = math::length(offset);
  if (!(math::dot(offset, axes_.forward) > 0.0)) return false;
  const sampling::Point2 square = sampling::uniform_disk_inverse(
      {math::dot(offset, axes_.right) / distance, math::dot(offset, axes_.down) / distance});
  point = {square.x, square.y};
  return true;
}

double HemisphereView::gsd_m(math::Point3 position_m) const {
  return std::sqrt(std::numbers::pi) * math::length(position_m - origin_m_);
}

CameraPose HemisphereView::pose(double) const {
  CameraPose pose;
  pose.axes = axes_;
  pose.position_m = origin_m_;
  return pose;
}

RayView::RayView(math::Point3 origin_m, math::Vec3 direction) : origin_m_(origin_m), direction_(direction) {
  require_finite({origin_m.x, origin_m.y, origin_m.z, direction.x, direction.y, direction.z}, "a ray");
}

void RayView::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    rays[i] = {.origin_m = origin_m_, .direction = direction_, .time_s = points[i].time_s};
}

double RayView::gsd_m(math::Point3) const {
  constexpr double kThin_m = 1e-6;
  return kThin_m;
}

CameraPose RayView::pose(double) const {
  CameraPose pose;
  pose.axes = axes_along(direction_);
  pose.position_m = origin_m_;
  return pose;
}

}  // namespace ifov::sensor
