#include "sensor/scanning/scan_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/format.h"
#include "platform/trajectory.h"

namespace ifov::sensor {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

bool positive(double value) { return value > 0.0 && std::isfinite(value); }

void check_pattern(const SweepPattern& p) {
  if (p.samples < 1 || p.elements < 1 || p.sweeps < 1)
    throw InputError(format("{} sweeps of {} samples by {} elements; expected at least 1 of each", p.sweeps,
                            p.samples, p.elements));
  if (!positive(p.step))
    throw InputError(format("elements of {} of the focal length each; expected a positive number", p.step));
  if (!positive(p.cone_rad) || !(p.cone_rad < std::numbers::pi))
    throw InputError(format("a line of sight {:g} deg off the axis that it turns about; expected more than 0",
                            p.cone_rad * kDegrees));
  if (!positive(p.turn_rad) || !(p.turn_rad * kDegrees <= 350.0))
    throw InputError(
        format("a sweep of {:g} deg; expected more than 0 and at most 350", p.turn_rad * kDegrees));
  if (p.amplitude_rad != 0.0 && !(p.amplitude_rad > 0.5 * p.turn_rad))
    throw InputError(format(
        "a line of sight that swings by {:g} deg to each side cannot sweep over {:g} deg; expected an amplitude above half of that",
        p.amplitude_rad * kDegrees, p.turn_rad * kDegrees));
  if (!positive(p.period_s) || !positive(p.sweep_s) || p.sweep_s > p.period_s * (1.0 + 1e-12))
    throw InputError(format(
        "sweeps of {:g} s every {:g} s; expected positive durations, and sweeps that end before the next begins",
        p.sweep_s, p.period_s));
  if (!(p.element_px >= 0.0) || !std::isfinite(p.element_px) || !positive(p.exposure) || p.exposure > 1.0)
    throw InputError(format(
        "an element of {} pitches, exposed for {} of a sample; expected 0 or more, and at most all of it",
        p.element_px, p.exposure));
}

}  // namespace

ScanCamera::ScanCamera(const Settings& settings) : settings_(settings) {
  check_pattern(settings.pattern);
  cover();
  hold_together();
  if (!settings.reported) return;
  Settings as_reported = settings;
  as_reported.platform = settings.reported, as_reported.reported = nullptr;
  reported_.reset(new ScanCamera(as_reported, Unjudged{}));
}

void ScanCamera::cover() const {
  const SweepPattern& p = pattern();
  const double start_s = p.start_s, end_s = p.start_s + (p.sweeps - 1) * p.period_s + p.sweep_s;
  // A row may end where the last sweep does, but for its rounding.
  const double rounding_s = 1e-9 * std::max(std::abs(start_s), std::abs(end_s));
  const double early_s = settings_.platform->first_s() - start_s,
               late_s = end_s - settings_.platform->last_s();
  if (!(early_s > rounding_s) && !(late_s > rounding_s)) return;
  throw InputError(
      format("the platform's path covers {:g} to {:g} s, and the {} sweeps take from {:g} to {:g} s: {}",
             settings_.platform->first_s(), settings_.platform->last_s(), p.sweeps, start_s, end_s,
             early_s > rounding_s && late_s > rounding_s
                 ? format("{:g} s too late and {:g} s too short", early_s, late_s)
             : early_s > rounding_s ? format("it begins {:g} s too late", early_s)
                                    : format("it ends {:g} s too early", late_s)));
}

std::unique_ptr<const SweepCamera> ScanCamera::sweep(int number) const {
  return std::make_unique<const SweepCamera>(pattern(), number, settings_.platform, settings_.reported);
}

int ScanCamera::number_of(double line_px) const {
  return static_cast<int>(std::clamp(std::floor(line_px / pattern().elements), 0.0, pattern().sweeps - 1.0));
}

SweepCamera ScanCamera::sweep_of(double line_px) const {
  return {pattern(), number_of(line_px), settings_.platform, nullptr};
}

void ScanCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
    const int number = number_of(points[first].y_px);
    std::vector<sampling::FocalPoint> own;
    for (; last < points.size() && number_of(points[last].y_px) == number; ++last) {
      own.push_back(points[last]);
      own.back().y_px -= static_cast<double>(number) * pattern().elements;
    }
    const SweepCamera sweep(pattern(), number, settings_.platform, nullptr);
    sweep.rays(own, rays.subspan(first, last - first));
  }
}

bool ScanCamera::project(math::Point3 position_m, sampling::FocalPoint& point) const {
  const double elements = pattern().elements;
  const auto seen_in = [&](int number) {
    const SweepCamera sweep(pattern(), number, settings_.platform, nullptr);
    sampling::FocalPoint at;
    return sweep.project(position_m, at) ? std::optional(at) : std::nullopt;
  };
  // Its place among the elements falls from sweep to sweep as the platform flies on: bisection, then the neighbours.
  int low = 0, high = pattern().sweeps - 1;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    const auto at = seen_in(middle);
    if (at && at->y_px > elements)
      low = middle + 1;
    else
      high = middle;
  }
  std::optional<double> nearest;
  for (int number = std::max(0, low - 1); number <= std::min(pattern().sweeps - 1, low + 1); ++number) {
    const auto at = seen_in(number);
    if (!at) continue;
    const double off = std::abs(at->y_px - 0.5 * elements);
    if (nearest && *nearest <= off) continue;
    nearest = off;
    point = {at->x_px, number * elements + at->y_px};
  }
  return nearest.has_value();
}

double ScanCamera::gsd_m(math::Point3 position_m) const {
  sampling::FocalPoint at{0.5 * width_px(), middle_line_px()};
  project(position_m, at);
  return sweep_of(at.y_px).gsd_m(position_m);
}

CameraPose ScanCamera::pose(double line_px) const { return sweep_of(line_px).pose(line_px); }

Ifov ScanCamera::ifov(double line_px) const { return sweep_of(line_px).ifov(0.5 * pattern().elements); }

void ScanCamera::hold_together() const {
  const SweepPattern& p = pattern();
  // As finely as the platform turns: within a sweep it may look back and ahead again.
  const double step_s = settings_.platform->step_s();
  constexpr double kMost = 1e6;
  const double parts = std::clamp(std::isinf(step_s) ? 1.0 : std::ceil(2.0 * p.sweep_s / step_s), 16.0,
                                  std::max(16.0, kMost / p.sweeps));
  double off = 0.0;
  for (int number = 0; number < p.sweeps; ++number) {
    const SweepCamera sweep(p, number, settings_.platform, nullptr);
    const double per_pitch = p.element_px > 0.0 ? sweep.along_line().element_px / p.element_px : 0.0;
    for (int k = 0; k < static_cast<int>(parts); ++k)
      for (const double ground_m : {settings_.lowest_m, settings_.highest_m}) {
        // Where an element meets level ground; none where it looks at the sky.
        const auto place = [&](double x, double ahead_px, double beside_px) -> std::optional<math::Point3> {
          const math::Ray ray = sweep.element_ray(x, ahead_px, beside_px);
          const double below_m = ray.origin_m.z - ground_m;
          if (!(below_m > 0.0) || !(ray.direction.z < 0.0)) return std::nullopt;
          return ray.origin_m + ray.direction * (below_m / -ray.direction.z);
        };
        const double x = (k + 0.5) / parts * p.samples, step = std::min(0.5, 0.25 * p.samples / parts);
        const auto before = place(x - step, 0.0, 0.0), after = place(x + step, 0.0, 0.0);
        if (!before || !after) continue;
        const math::Vec3 onward =
            sweep.element_ray(x, 0.0, 0.5).direction - sweep.element_ray(x, 0.0, -0.5).direction;
        if (!(math::dot(*after - *before, onward) > 0.0))
          throw InputError(format(
              "sample {:.4g} of sweep {} does not look beyond the one before it: by {:.4g} s the platform turns faster than "
              "the sweep, and the same ground would be seen more than once in it",
              x, number + 1, sweep.time_s(x)));
        if (!(p.element_px > 0.0)) continue;
        for (const double ahead : {-0.5 * p.elements, 0.5 * p.elements})
          for (const double beside : {-0.5 * p.element_px, 0.5 * p.element_px}) {
            const auto seen = place(x, ahead, beside);
            sampling::FocalPoint at;
            if (!seen || !sweep.project(*seen, at)) continue;
            off = std::max({off, std::abs(at.x_px - x - beside * per_pitch),
                            std::abs(at.y_px - 0.5 * p.elements - ahead)});
          }
      }
  }
  if (off > kMost_px)
    throw InputError(format(
        "what elements {:.3g} pitches wide see is {:.2g} pixels off from what is known of their samples, as the platform moves while they pass; "
        "expected {:g} pixels at most: a smaller 'element_width', or none",
        p.element_px, off, kMost_px));
}

}  // namespace ifov::sensor
