#include "platform/mounts/programmed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/format.h"

namespace ifov::platform {
namespace {

std::vector<double> components(std::span<const geodesy::Attitude> angles) {
  std::vector<double> values;
  for (const geodesy::Attitude& one : angles)
    values.insert(values.end(), {one.yaw_rad, one.pitch_rad, one.roll_rad});
  return values;
}

double shortest(std::span<const double> times_s) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < times_s.size(); ++k) step = std::min(step, times_s[k] - times_s[k - 1]);
  return step;
}

}  // namespace

geodesy::Attitude StepStare::angles(double time_s, const Pose&) const {
  const double periods = (time_s - settings_.start_s) / settings_.period_s;
  const double whole = std::floor(periods);
  const auto place = [&](double number) {
    return number - settings_.steps * std::floor(number / settings_.steps);
  };
  double at = place(whole);
  const double slewing = settings_.slew_s / settings_.period_s, left = 1.0 - (periods - whole);
  if (left < slewing)
    at += (place(whole + 1.0) - at) * 0.5 * (1.0 - std::cos(std::numbers::pi * (1.0 - left / slewing)));
  const geodesy::Attitude &first = settings_.first, &step = settings_.step;
  return {first.yaw_rad + at * step.yaw_rad, first.pitch_rad + at * step.pitch_rad,
          first.roll_rad + at * step.roll_rad};
}

double StepStare::step_s() const {
  return settings_.slew_s > 0.0 ? std::min(settings_.slew_s, settings_.period_s - settings_.slew_s)
                                : settings_.period_s;
}

void StepStare::check(std::span<const double>, std::span<const geodesy::Attitude>) const {}

TurnTable::TurnTable(std::vector<double> times_s, std::span<const geodesy::Attitude> angles)
    : step_s_(shortest(times_s)), spline_(std::move(times_s), components(angles)) {}

geodesy::Attitude TurnTable::angles(double time_s, const Pose&) const {
  std::array<double, 3> at{};
  spline_.at(std::clamp(time_s, spline_.first(), spline_.last()), at);
  return {at[0], at[1], at[2]};
}

void TurnTable::check(std::span<const double> times_s, std::span<const geodesy::Attitude>) const {
  const double rounding_s = 1e-9 * std::max(std::abs(times_s.front()), std::abs(times_s.back()));
  if (spline_.first() > times_s.front() + rounding_s || spline_.last() < times_s.back() - rounding_s)
    throw InputError(
        format("the mount's table covers {:g} to {:g} s, and the image is exposed from {:g} to {:g} s",
               spline_.first(), spline_.last(), times_s.front(), times_s.back()));
}

}  // namespace ifov::platform
