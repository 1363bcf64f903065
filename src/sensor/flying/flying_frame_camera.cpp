#include "sensor/flying/flying_frame_camera.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "platform/trajectory.h"
#include "sensor/frame_camera.h"

namespace ifov::sensor {

struct FlyingFrameCamera::Stand {
  math::Point3 position_m;
  CameraAxes axes;
};

FlyingFrameCamera::FlyingFrameCamera(const Settings& settings, Unjudged)
    : settings_(settings), rows_(settings.height_px) {}

FlyingFrameCamera::FlyingFrameCamera(const Settings& settings) : FlyingFrameCamera(settings, Unjudged{}) {
  // What is wrong with one that stands still is wrong here.
  const FrameCamera still({settings.width_px,
                           settings.height_px,
                           settings.focal_length_m,
                           settings.pitch_m,
                           {},
                           {},
                           settings.exposure_s,
                           settings.row_period_s,
                           settings.lens});
  const double half_s = 0.5 * (settings.exposure_s + (settings.height_px - 1) * settings.row_period_s);
  // A row may end where the exposure does, but for its rounding.
  const double rounding_s = 1e-9 * half_s;
  const double early_s = settings.platform->first_s() + half_s, late_s = half_s - settings.platform->last_s();
  const bool early = early_s > rounding_s, late = late_s > rounding_s;
  if (early || late)
    throw InputError(
        format("the platform's path covers {:g} to {:g} s, and the image is exposed from {:g} to {:g} s: {}",
               settings.platform->first_s(), settings.platform->last_s(), -half_s, half_s,
               early && late ? format("{:g} s too late and {:g} s too short", early_s, late_s)
               : early       ? format("it begins {:g} s too late", early_s)
                             : format("it ends {:g} s too early", late_s)));
  if (!settings.reported) return;
  Settings as_reported = settings;
  as_reported.platform = settings.reported, as_reported.reported = nullptr;
  reported_.reset(new FlyingFrameCamera(as_reported, Unjudged{}));
}

std::unique_ptr<const Camera> FlyingFrameCamera::picture(int number) const { return row(number); }

std::unique_ptr<FlyingFrameCamera> FlyingFrameCamera::row(int number) const {
  std::unique_ptr<FlyingFrameCamera> row(new FlyingFrameCamera(settings_, Unjudged{}));
  row->settings_.row_period_s = 0.0;
  row->rows_ = 1;
  row->first_row_ = number;
  row->middle_s_ = row_time_s(number);
  if (reported_) row->reported_ = reported_->row(number);
  return row;
}

std::unique_ptr<const Camera> FlyingFrameCamera::at_instant(double time_s) const {
  std::unique_ptr<FlyingFrameCamera> camera(new FlyingFrameCamera(settings_, Unjudged{}));
  camera->settings_.exposure_s = 0.0;
  camera->rows_ = rows_, camera->first_row_ = first_row_;
  camera->middle_s_ = middle_s_ + time_s;
  return camera;
}

double FlyingFrameCamera::step_s() const { return settings_.platform->step_s(); }

double FlyingFrameCamera::row_time_s(double y_px) const {
  if (settings_.row_period_s == 0.0) return middle_s_;
  const double within_px = std::clamp(y_px, -kBeyond_px, settings_.height_px + kBeyond_px);
  return middle_s_ + (std::floor(within_px) + 0.5 - 0.5 * settings_.height_px) * settings_.row_period_s;
}

FlyingFrameCamera::Stand FlyingFrameCamera::stand_at(double time_s) const {
  const platform::Pose pose = settings_.platform->pose(time_s);
  return {pose.position_m, {pose.enu_from_body.y().v, -pose.enu_from_body.x().v, pose.enu_from_body.z().v}};
}

void FlyingFrameCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  const double step = settings_.pitch_m / settings_.focal_length_m;
  double time_s = NAN;
  Stand stand;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const sampling::FocalPoint& p = points[i];
    const double own_s = row_time_s(p.y_px) + p.time_s;
    if (own_s != time_s) stand = stand_at(own_s), time_s = own_s;
    const double right = (p.x_px - 0.5 * settings_.width_px) * step,
                 down = (p.y_px + first_row_ - 0.5 * settings_.height_px) * step;
    const Lens::Place there =
        settings_.lens ? settings_.lens->direction_of({right, down}) : Lens::Place{right, down};
    rays[i] = {.origin_m = stand.position_m,
               .direction = math::normalized(stand.axes.forward + stand.axes.right * there.x +
                                             stand.axes.down * there.y),
               .time_s = own_s};
  }
}

bool FlyingFrameCamera::seen(const Stand& stand, math::Point3 position_m, sampling::FocalPoint& point) const {
  const math::Vec3 offset = position_m - stand.position_m;
  const double depth = math::dot(offset, stand.axes.forward);
  if (!(depth > 0.0)) return false;
  if (settings_.lens) {
    const Lens::Place there = settings_.lens->image_of(
        {math::dot(offset, stand.axes.right) / depth, math::dot(offset, stand.axes.down) / depth});
    const double pixels = settings_.focal_length_m / settings_.pitch_m;
    point = {0.5 * settings_.width_px + there.x * pixels,
             0.5 * settings_.height_px - first_row_ + there.y * pixels};
    return true;
  }
  const double scale = settings_.focal_length_m / (settings_.pitch_m * depth);
  point = {0.5 * settings_.width_px + math::dot(offset, stand.axes.right) * scale,
           0.5 * settings_.height_px - first_row_ + math::dot(offset, stand.axes.down) * scale};
  return true;
}

bool FlyingFrameCamera::project_when(math::Point3 position_m, double time_s,
                                     sampling::FocalPoint& point) const {
  if (settings_.row_period_s == 0.0) return seen(stand_at(middle_s_ + time_s), position_m, point);
  const double half_px = 0.5 * settings_.height_px;
  // How much further down than y the point is while a row there would be exposed, as if rows had no height.
  const auto below_px = [&](double y) -> std::optional<double> {
    const double within_px = std::clamp(y, -kBeyond_px, settings_.height_px + kBeyond_px);
    sampling::FocalPoint at;
    if (!seen(stand_at(middle_s_ + (within_px - half_px) * settings_.row_period_s + time_s), position_m, at))
      return std::nullopt;
    return at.y_px - y;
  };
  double before = half_px;
  std::optional<double> below_before = below_px(before);
  if (!below_before) return false;
  double y = before + *below_before;
  for (int k = 0; k < 50; ++k) {
    const std::optional<double> below = below_px(y);
    if (!below) return false;
    const double change = *below - *below_before;
    const double step = change != 0.0 ? -*below * (y - before) / change : *below;
    if (std::abs(step) <= 1e-9 || !std::isfinite(step)) break;
    before = y, below_before = below;
    // Not further than where it is seen now is away, twice over: where secants run along.
    y += std::clamp(step, -2.0 * std::abs(*below), 2.0 * std::abs(*below));
  }
  const double row = std::floor(y);
  if (!seen(stand_at(row_time_s(row) + time_s), position_m, point)) return false;
  point.y_px = std::clamp(point.y_px, row, std::nextafter(row + 1.0, row));
  return true;
}

double FlyingFrameCamera::gsd_m(math::Point3 position_m) const {
  sampling::FocalPoint at{0.5 * width_px(), middle_line_px()};
  if (settings_.row_period_s > 0.0) project(position_m, at);
  const Stand stand = stand_at(row_time_s(at.y_px));
  const math::Vec3 offset = position_m - stand.position_m;
  const double depth = math::dot(offset, stand.axes.forward);
  const double plain = std::abs(depth) * settings_.pitch_m / settings_.focal_length_m;
  if (!settings_.lens || depth == 0.0) return plain;
  return plain / std::sqrt(settings_.lens->scale({math::dot(offset, stand.axes.right) / depth,
                                                  math::dot(offset, stand.axes.down) / depth}));
}

CameraPose FlyingFrameCamera::pose(double line_px) const {
  const double time_s = row_time_s(line_px);
  const Stand stand = stand_at(time_s);
  return {stand.axes, stand.position_m, settings_.focal_length_m, settings_.pitch_m, time_s};
}

CameraAxes FlyingFrameCamera::axes_at(const sampling::FocalPoint& point) const {
  return stand_at(row_time_s(point.y_px) + point.time_s).axes;
}

}  // namespace ifov::sensor
