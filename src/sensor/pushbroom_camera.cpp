#include "sensor/pushbroom_camera.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "platform/trajectory.h"
#include "sensor/lens/lens.h"

namespace ifov::sensor {

struct PushbroomCamera::Line {
  math::Point3 position_m;
  math::Vec3 velocity_m_s;
  CameraAxes axes;
};

PushbroomCamera::PushbroomCamera(const Settings& settings) : settings_(settings) {
  if (settings.width_px < 1 || settings.height_px < 1)
    throw InputError(
        format("an image of {} x {} pixels; expected at least 1 x 1", settings.width_px, settings.height_px));
  if (!(settings.step > 0.0) || !std::isfinite(settings.step))
    throw InputError(format("a line of elements of {} of the focal length each; expected a positive number",
                            settings.step));
  if (!(settings.line_period_s > 0.0) || !std::isfinite(settings.line_period_s))
    throw InputError(format("a line period of {} s; expected a positive duration", settings.line_period_s));
  if (!(settings.exposure_s >= 0.0) || !(settings.exposure_s <= settings.line_period_s))
    throw InputError(format("an exposure of {:g} s in a line period of {:g} s; expected at most the period",
                            settings.exposure_s, settings.line_period_s));
  if (!(settings.element_px >= 0.0) || !std::isfinite(settings.element_px) || settings.stages < 1)
    throw InputError(format("an element of {} pitches in {} stages; expected 0 or more, and 1 stage at least",
                            settings.element_px, settings.stages));
  // The first stages of a line are exposed before it, the last after it.
  const double early_by_s = 0.5 * (settings.stages - 1) * settings.line_period_s;
  const double start_s = settings.start_s - early_by_s,
               end_s = settings.start_s + settings.height_px * settings.line_period_s + early_by_s;
  // A row may end where the last line does, but for its rounding.
  const double rounding_s = 1e-9 * std::max(std::abs(start_s), std::abs(end_s));
  const double early_s = settings.platform->first_s() - start_s, late_s = end_s - settings.platform->last_s();
  if (early_s > rounding_s || late_s > rounding_s)
    throw InputError(format(
        "the platform's path covers {:g} to {:g} s, and the {} lines are exposed from {:g} to {:g} s: {}",
        settings.platform->first_s(), settings.platform->last_s(), settings.height_px, start_s, end_s,
        early_s > rounding_s && late_s > rounding_s
            ? format("{:g} s too late and {:g} s too short", early_s, late_s)
        : early_s > rounding_s ? format("it begins {:g} s too late", early_s)
                               : format("it ends {:g} s too early", late_s)));
  check_lens();
  hold_together();
  if (settings.element_px > 0.0 || settings.stages > 1)
    find_lines_a_pitch();
  else
    lines_a_pitch_ = mean_lines_a_pitch();
  if (!settings.reported) return;
  Settings as_reported = settings;
  as_reported.platform = settings.reported, as_reported.reported = nullptr;
  reported_.reset(new PushbroomCamera(as_reported, Unjudged{}));
}

PushbroomCamera::Line PushbroomCamera::line_at(double y_px, double time_s) const {
  const double within_px = std::clamp(y_px, -kBeyond_px, settings_.height_px + kBeyond_px);
  const platform::Pose pose =
      settings_.platform->pose(settings_.start_s + within_px * settings_.line_period_s + time_s);
  const double beyond_s = (y_px - within_px) * settings_.line_period_s;
  return {pose.position_m + pose.velocity_m_s * beyond_s,
          pose.velocity_m_s,
          {-pose.enu_from_body.y().v, pose.enu_from_body.x().v, pose.enu_from_body.z().v}};
}

std::array<double, 2> PushbroomCamera::towards(double x_px, double ahead_px) const {
  const double across = (x_px - 0.5 * settings_.width_px) * settings_.step, ahead = ahead_px * settings_.step;
  if (!settings_.lens) return {across, ahead};
  const Lens::Place there = settings_.lens->direction_of({across, ahead});
  return {there.x, there.y};
}

void PushbroomCamera::check_lens() const {
  if (!settings_.lens) return;
  const double middle = 0.5 * settings_.width_px;
  double right = towards(middle)[0], left = right;
  // Outwards from the middle, so that the first element that is told is the one where it begins.
  for (int k = 1; k <= settings_.width_px; ++k) {
    const double beside = 0.5 * k, after = towards(middle + beside)[0], before = towards(middle - beside)[0];
    for (const double sign : {-1.0, 1.0})
      if (!settings_.lens->holds({sign * beside * settings_.step, 0.0}) ||
          !(sign > 0.0 ? after > right : before < left))
        throw InputError(format(
            "the lens distortion folds back within the line: no direction has its image at element {:.0f} and beyond; expected terms "
            "that go on rising to its ends",
            std::clamp(std::floor(middle + sign * beside), 0.0, settings_.width_px - 1.0) + 1.0));
    right = after, left = before;
  }
}

double PushbroomCamera::place_of(double right) const {
  const double middle = 0.5 * settings_.width_px;
  double x = middle + right / settings_.step;
  if (!settings_.lens) return x;
  // Secants: directions rise along the line, and bend little over an element.
  constexpr double kLeft_px = 1e-12;
  double before = middle, off_before = towards(middle)[0] - right;
  for (int k = 0; k < 100; ++k) {
    const double off = towards(x)[0] - right, change = off - off_before;
    if (off == 0.0 || change == 0.0) break;
    const double step = -off * (x - before) / change;
    before = x, off_before = off;
    x += std::clamp(step, -settings_.width_px - std::abs(x), settings_.width_px + std::abs(x));
    if (std::abs(step) <= std::max(kLeft_px, 4e-16 * std::abs(x))) break;
  }
  return x;
}

void PushbroomCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const sampling::FocalPoint& p = points[i];
    const Line line = line_at(p.y_px, p.time_s);
    const auto [right, down] = towards(p.x_px);
    rays[i] = {.origin_m = line.position_m,
               .direction = math::normalized(settings_.lens ? line.axes.forward + line.axes.right * right +
                                                                  line.axes.down * down
                                                            : line.axes.forward + line.axes.right * right),
               .time_s = settings_.start_s + p.y_px * settings_.line_period_s + p.time_s};
  }
}

/// How far the point is still ahead of what a line sees as far to its right, metres.
double PushbroomCamera::ahead_m(const Line& line, math::Point3 point_m) const {
  const math::Vec3 offset = point_m - line.position_m;
  const double ahead = math::dot(offset, line.axes.down);
  if (!settings_.lens) return ahead;
  const double depth = math::dot(offset, line.axes.forward);
  if (!(depth > 0.0)) return ahead;
  return ahead - depth * towards(place_of(math::dot(offset, line.axes.right) / depth))[1];
}

std::optional<double> PushbroomCamera::line_of(math::Point3 point_m) const {
  double low = -kBeyond_px, high = settings_.height_px + kBeyond_px;
  const Line first = line_at(low), last = line_at(high);
  double f_low = ahead_m(first, point_m), f_high = ahead_m(last, point_m);
  // Before the first line and after the last it flies straight.
  for (const auto& [line, f, y, before] :
       {std::tuple{&first, f_low, low, true}, {&last, f_high, high, false}}) {
    if (before ? f > 0.0 : f < 0.0) continue;
    const double step_m = math::dot(line->velocity_m_s, line->axes.down) * settings_.line_period_s;
    if (!(step_m > 0.0)) return std::nullopt;
    double there = y + f / step_m;
    // Beside the line others look further ahead: as often as it takes.
    constexpr double kLeft_px = 1e-11;
    for (int k = 0; settings_.lens && k < 50; ++k) {
      const double left = ahead_m(line_at(there), point_m) / step_m;
      there += left;
      if (std::abs(left) <= std::max(kLeft_px, 4e-16 * std::abs(there))) break;
    }
    return there;
  }
  // As if lines were even, then secants; bisection where these leave the bracket or hardly narrow it.
  constexpr double kLeft_px = 1e-11;
  double y = low + (high - low) * f_low / (f_low - f_high);
  double y_before = low, f_before = f_low;
  for (int k = 0; k < 100; ++k) {
    const double f = ahead_m(line_at(y), point_m);
    if (f == 0.0) return y;
    (f > 0.0 ? low : high) = y;
    double next = y - f * (y - y_before) / (f - f_before);
    y_before = y, f_before = f;
    if (std::abs(next - y) <= std::max(kLeft_px, 4e-16 * std::abs(y))) return next;
    if (!(next > low && next < high) || k % 8 == 7) next = 0.5 * (low + high);
    if (high - low <= kLeft_px) return next;
    y = next;
  }
  return y;
}

bool PushbroomCamera::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const std::optional<double> y_px = line_of(position_m);
  if (!y_px) return false;
  const Line line = line_at(*y_px);
  const math::Vec3 offset = position_m - line.position_m;
  const double depth = math::dot(offset, line.axes.forward);
  if (!(depth > 0.0)) return false;
  point = settings_.lens
              ? sampling::FocalPoint{place_of(math::dot(offset, line.axes.right) / depth), *y_px}
              : sampling::FocalPoint{
                    0.5 * settings_.width_px + math::dot(offset, line.axes.right) / (depth * settings_.step),
                    *y_px};
  return true;
}

double PushbroomCamera::gsd_m(math::Point3 position_m) const {
  const double y_px = line_of(position_m).value_or(middle_line_px());
  const Line line = line_at(y_px);
  const double depth = std::abs(math::dot(position_m - line.position_m, line.axes.forward));
  const double across = math::dot(position_m - line.position_m, line.axes.right) / std::max(depth, 1e-300);
  const double x_px = settings_.lens ? place_of(across) : 0.0;
  const double ahead = settings_.lens ? towards(x_px)[1] : 0.0;
  // Where the rays half a line before and after meet the plane across the line of sight.
  const auto met = [&](double y) {
    const Line at = line_at(y);
    const math::Vec3 d = at.axes.forward + at.axes.right * across + at.axes.down * ahead;
    const double along =
        math::dot(position_m - at.position_m, line.axes.forward) / math::dot(d, line.axes.forward);
    return at.position_m + d * along;
  };
  const math::Vec3 lines = met(y_px + 0.5) - met(y_px - 0.5);
  if (settings_.lens) {
    const auto before = towards(x_px - 0.5), after = towards(x_px + 0.5);
    return std::sqrt(depth * std::abs((after[0] - before[0]) * math::dot(lines, line.axes.down) -
                                      (after[1] - before[1]) * math::dot(lines, line.axes.right)));
  }
  return std::sqrt(depth * settings_.step * std::abs(math::dot(lines, line.axes.down)));
}

CameraPose PushbroomCamera::pose(double line_px) const {
  const Line line = line_at(line_px);
  return {line.axes, line.position_m, settings_.focal_length_m, settings_.focal_length_m * settings_.step,
          settings_.start_s + line_px * settings_.line_period_s};
}

void PushbroomCamera::hold_together() const {
  const double width = settings_.width_px;
  const auto ground = [](const math::Ray& ray) {
    // What does not look down is judged as far away as it is high.
    const double height_m = std::max(std::abs(ray.origin_m.z), 1.0);
    return ray.origin_m +
           ray.direction *
               (ray.direction.z < 0.0 && ray.origin_m.z > 0.0 ? height_m / -ray.direction.z : height_m);
  };
  // As finely as the platform turns: between two lines it may look back and ahead again.
  constexpr double kMost = 2e6;
  const double parts = std::clamp(std::ceil(settings_.line_period_s / settings_.platform->step_s()), 1.0,
                                  std::max(1.0, kMost / settings_.height_px));
  const auto steps = static_cast<std::int64_t>(parts);
  Line next = line_at(0.0);
  for (std::int64_t step = 0; step < settings_.height_px * steps; ++step) {
    const Line line = next;
    const double y = static_cast<double>(step) / parts;
    next = line_at(static_cast<double>(step + 1) / parts);
    if (!(line.position_m.z > 0.0)) continue;  // of a satellite that has set
    for (const double x : {0.0, 0.5 * width, width}) {
      const auto [right, down] = towards(x);
      const math::Point3 point_m =
          ground({.origin_m = line.position_m,
                  .direction =
                      math::normalized(line.axes.forward + line.axes.right * right + line.axes.down * down)});
      const double back_m = ahead_m(next, point_m);
      if (!(back_m < 0.0))
        throw InputError(format(
            "line {:g} of the scanner looks {:.3g} m behind line {:g}: the platform stands still, flies backwards or turns back faster than "
            "it flies, and the same ground would be seen more than once",
            static_cast<double>(step + 1) / parts, back_m, y));
    }
  }
}

}  // namespace ifov::sensor
