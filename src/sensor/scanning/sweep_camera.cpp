#include "sensor/scanning/sweep_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "platform/trajectory.h"

namespace ifov::sensor {

double SweepPattern::sine_sweep_s(double turn_rad, double amplitude_rad, double cycle_s) {
  return cycle_s / std::numbers::pi * std::asin(0.5 * turn_rad / amplitude_rad);
}

double SweepPattern::longest_sample_s() const {
  const double even_s = sweep_s / samples;
  if (!(amplitude_rad > 0.0)) return even_s;
  const double widest = 0.5 * turn_rad / amplitude_rad;
  return even_s * widest / (std::asin(widest) * std::sqrt(1.0 - widest * widest));
}

struct SweepCamera::Axes {
  math::Vec3 axis, first, side;
  double outwards = 1.0;  // whether elements further ahead look away from the axis (1) or towards it (-1)
};

SweepCamera::Axes SweepCamera::axes_of(const SweepPattern& pattern, const CameraAxes& body) {
  switch (pattern.axis) {
    case SweepPattern::Axis::nose: return {body.down, body.forward, body.right, -1.0};
    case SweepPattern::Axis::belly_looking_ahead: return {body.forward, body.down, body.right, 1.0};
    case SweepPattern::Axis::belly_looking_behind: return {body.forward, -body.down, body.right, -1.0};
  }
  return {};
}

/// The line of sight at an instant: where from, along the middle element, and how that changes towards elements ahead and samples beside.
struct SweepCamera::Look {
  Axes axes;
  math::Point3 position_m;
  double time_s = 0.0, turn_rad = 0.0;
  math::Vec3 sight, ahead, beside;
};

SweepCamera::SweepCamera(const SweepPattern& pattern, int number,
                         std::shared_ptr<const platform::Trajectory> platform,
                         std::shared_ptr<const platform::Trajectory> reported)
    : pattern_(pattern),
      number_(number),
      back_(pattern.reversed != (pattern.both_ways && number % 2 == 1)),
      platform_(std::move(platform)) {
  if (reported)
    reported_ = std::make_unique<const SweepCamera>(pattern, number, std::move(reported), nullptr);
}

double SweepCamera::time_s(double x_px) const {
  const double begins_s = pattern_.start_s + number_ * pattern_.period_s;
  const double along = back_ ? pattern_.samples - x_px : x_px;
  double share = along / pattern_.samples;
  if (pattern_.amplitude_rad > 0.0) {
    // Beyond its ends as fast as there: the picture goes on, the mirror would not.
    const double within = std::clamp(share, 0.0, 1.0);
    const double widest = 0.5 * pattern_.turn_rad / pattern_.amplitude_rad;
    const auto turned = [&](double at) { return std::asin(widest * (2.0 * at - 1.0)); };
    const double all = 2.0 * std::asin(widest);
    const double slope = pattern_.longest_sample_s() * pattern_.samples / pattern_.sweep_s;
    share = 0.5 + turned(within) / all + (share - within) * slope;
  }
  return begins_s + share * pattern_.sweep_s;
}

SweepCamera::Look SweepCamera::look(double x_px, double time_s) const {
  Look look;
  look.time_s = this->time_s(x_px) + time_s;
  const double within_px = std::clamp(x_px, -kBeyond_px, pattern_.samples + kBeyond_px);
  const platform::Pose pose = platform_->pose(this->time_s(within_px) + time_s);
  look.position_m = pose.position_m;
  look.axes =
      axes_of(pattern_, {-pose.enu_from_body.y().v, pose.enu_from_body.x().v, pose.enu_from_body.z().v});
  look.turn_rad = (x_px - 0.5 * pattern_.samples) * pattern_.turn_per_sample_rad();
  const double c = std::cos(pattern_.cone_rad), s = std::sin(pattern_.cone_rad);
  const math::Vec3 from_axis =
      look.axes.first * std::cos(look.turn_rad) + look.axes.side * std::sin(look.turn_rad);
  look.beside = look.axes.side * std::cos(look.turn_rad) - look.axes.first * std::sin(look.turn_rad);
  look.sight = look.axes.axis * c + from_axis * s;
  look.ahead = (from_axis * c - look.axes.axis * s) * look.axes.outwards;
  return look;
}

void SweepCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Look at = look(points[i].x_px, points[i].time_s);
    const double ahead = (points[i].y_px - 0.5 * pattern_.elements) * pattern_.step;
    rays[i] = {.origin_m = at.position_m,
               .direction = math::normalized(at.sight + at.ahead * ahead),
               .time_s = at.time_s};
  }
}

math::Ray SweepCamera::element_ray(double x_px, double ahead_px, double beside_px) const {
  const Look at = look(x_px);
  return {.origin_m = at.position_m,
          .direction = math::normalized(at.sight + at.ahead * (ahead_px * pattern_.step) +
                                        at.beside * (beside_px * pattern_.step)),
          .time_s = at.time_s};
}

bool SweepCamera::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const double per_sample = pattern_.turn_per_sample_rad(), middle = 0.5 * pattern_.samples;
  // How many samples behind the point's turn about the axis lies, within half a turn of the sweep's middle.
  const auto left_px = [&](double x) {
    const Look at = look(x);
    const math::Vec3 to = position_m - at.position_m;
    const double turn = std::atan2(math::dot(to, at.axes.side), math::dot(to, at.axes.first));
    return turn / per_sample + middle - x;
  };
  const double widest_px = std::numbers::pi / per_sample;
  constexpr double kLeft_px = 1e-11;
  double x_before = middle, f_before = left_px(x_before);
  double x = std::clamp(middle + f_before, middle - widest_px, middle + widest_px);
  for (int k = 0; k < 60; ++k) {
    const double f = left_px(x);
    // The platform moves little in a sample: the slope is nearly -1.
    double slope = x != x_before ? (f - f_before) / (x - x_before) : -1.0;
    if (!(slope < -0.25 && slope > -4.0)) slope = -1.0;
    x_before = x, f_before = f;
    x -= f / slope;
    if (std::abs(x - x_before) <= std::max(kLeft_px, 4e-16 * std::abs(x))) break;
  }
  const Look at = look(x);
  const math::Vec3 to = position_m - at.position_m;
  const double along = math::dot(to, at.sight), ahead = math::dot(to, at.ahead);
  if (!(along > 0.0)) return false;
  point = {x, 0.5 * pattern_.elements + ahead / (along * pattern_.step)};
  return std::isfinite(point.x_px) && std::isfinite(point.y_px);
}

double SweepCamera::gsd_m(math::Point3 position_m) const {
  sampling::FocalPoint at;
  if (!project(position_m, at)) at = {0.5 * pattern_.samples, 0.5 * pattern_.elements};
  const Look look = this->look(at.x_px);
  const double distance_m = math::length(position_m - look.position_m);
  // Where rays half a sample before and after, and half an element, meet the plane through the point across the sight.
  const math::Vec3 across = ray(at).direction;
  const auto met = [&](double x, double y) {
    const math::Ray ray = this->ray({x, y});
    return ray.origin_m +
           ray.direction * (math::dot(position_m - ray.origin_m, across) / math::dot(ray.direction, across));
  };
  const math::Vec3 beside = met(at.x_px + 0.5, at.y_px) - met(at.x_px - 0.5, at.y_px);
  const math::Vec3 ahead = met(at.x_px, at.y_px + 0.5) - met(at.x_px, at.y_px - 0.5);
  const double area_m2 = math::length(math::cross(beside, ahead));
  return std::isfinite(area_m2) ? std::sqrt(area_m2) : distance_m * pattern_.step;
}

CameraPose SweepCamera::pose(double) const {
  const Look at = look(0.5 * pattern_.samples);
  return {{at.beside, at.ahead, at.sight},
          at.position_m,
          pattern_.focal_length_m,
          pattern_.focal_length_m * pattern_.step,
          at.time_s};
}

CameraAxes SweepCamera::axes_at(const sampling::FocalPoint& point) const {
  const Look at = look(point.x_px, point.time_s);
  return {at.beside, at.ahead, at.sight};
}

AlongTrack SweepCamera::along_line() const {
  const double pitch_px = pattern_.step / (std::sin(pattern_.cone_rad) * pattern_.turn_per_sample_rad());
  return {.exposure_px = pattern_.exposure,
          .element_px = pattern_.element_px * pitch_px,
          .pitch_px = pitch_px,
          .timed = true};
}

}  // namespace ifov::sensor
