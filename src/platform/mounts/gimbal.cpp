#include "platform/mounts/gimbal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/format.h"
#include "core/overloaded.h"
#include "platform/trajectory.h"

namespace ifov::platform {
namespace {

constexpr double kGimbalDegree = std::numbers::pi / 180.0;

/// The axes by the names that documents give them.
struct GimbalAxis {
  const char* name;
  double geodesy::Attitude::*angle;
  std::optional<Gimbal::Limits> Gimbal::Settings::*limits;
};
constexpr std::array<GimbalAxis, 3> kGimbalAxes{
    {{"yaw", &geodesy::Attitude::yaw_rad, &Gimbal::Settings::yaw},
     {"pitch", &geodesy::Attitude::pitch_rad, &Gimbal::Settings::pitch},
     {"roll", &geodesy::Attitude::roll_rad, &Gimbal::Settings::roll}}};

/// Where an axis that reaches so far stands to be nearest to an angle, around the circle.
double stopped_at(double angle, const Gimbal::Limits& limits) {
  if (angle >= limits.least_rad && angle <= limits.most_rad) return angle;
  const auto away = [&](double limit) {
    return std::abs(std::remainder(angle - limit, 2.0 * std::numbers::pi));
  };
  return away(limits.least_rad) <= away(limits.most_rad) ? limits.least_rad : limits.most_rad;
}

}  // namespace

math::Point3 Gimbal::target_m(double time_s) const {
  return std::visit(
      Overloaded{[](const math::Point3& point) { return point; },
                 [&](const Follow& follow) {
                   const Pose pose = follow.path->pose(time_s);
                   const math::Vec3 offset = follow.offset_m;
                   return pose.position_m +
                          pose.enu_from_body(geodesy::BodyVector{{offset.y, offset.x, -offset.z}}).v;
                 }},
      settings_.target);
}

geodesy::Attitude Gimbal::towards(math::Point3 target_m, const Pose& carrier) const {
  const math::Vec3 line = math::normalized(target_m - carrier.position_m);
  const double nose = math::dot(line, carrier.enu_from_body.x().v),
               right = math::dot(line, carrier.enu_from_body.y().v),
               belly = math::dot(line, carrier.enu_from_body.z().v);
  switch (settings_.axes) {
    case Axes::pitch_roll: return {0.0, std::atan2(nose, belly), -std::asin(std::clamp(right, -1.0, 1.0))};
    case Axes::pan_tilt: return {std::atan2(right, nose), std::atan2(std::hypot(nose, right), belly), 0.0};
  }
  return {};
}

geodesy::Attitude Gimbal::angles(double time_s, const Pose& carrier) const {
  geodesy::Attitude angles = towards(target_m(time_s), carrier);
  if (settings_.stops)
    for (const GimbalAxis& axis : kGimbalAxes)
      if (const auto& limits = settings_.*axis.limits)
        angles.*axis.angle = stopped_at(angles.*axis.angle, *limits);
  return angles;
}

std::string Gimbal::told(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const {
  std::string told = format("gimbal towards {}, {}", settings_.name, angles_told(angles));
  if (!settings_.stops) return told;
  for (const GimbalAxis& axis : kGimbalAxes) {
    const auto& limits = settings_.*axis.limits;
    if (!limits) continue;
    const auto stopped = [&](std::size_t k) {
      return angles[k].*axis.angle == limits->least_rad || angles[k].*axis.angle == limits->most_rad;
    };
    std::size_t count = 0, first = 0, last = 0;
    for (std::size_t k = 0; k < times_s.size(); ++k)
      if (stopped(k)) {
        if (count++ == 0) first = k;
        last = k;
      }
    if (count == 0) continue;
    told += format("; its {} is at a limit ", axis.name);
    if (count == times_s.size())
      told += "all the time";
    else if (count == last - first + 1)
      told += format("from {:.4g} to {:.4g} s", times_s[first], times_s[last]);
    else
      told += format("{:.2g} % of the time, first at {:.4g} s and last at {:.4g} s",
                     100.0 * static_cast<double>(count) / static_cast<double>(times_s.size()), times_s[first],
                     times_s[last]);
  }
  return told;
}

double Gimbal::step_s() const {
  const auto* follow = std::get_if<Follow>(&settings_.target);
  return follow != nullptr ? follow->path->step_s() : std::numeric_limits<double>::infinity();
}

void Gimbal::check(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const {
  constexpr double kKeyhole_rad = 1e-6;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    const auto refuse = [&](const std::string& why) {
      throw InputError(
          format("at {:.6g} s the gimbal cannot look at {}: {}", times_s[k], settings_.name, why));
    };
    const geodesy::Attitude& at = angles[k];
    if (!std::isfinite(at.yaw_rad) || !std::isfinite(at.pitch_rad) || !std::isfinite(at.roll_rad))
      refuse("it is there itself");
    if (settings_.axes == Axes::pan_tilt && std::abs(std::sin(at.pitch_rad)) < kKeyhole_rad)
      refuse(
          "it is along the axis that pans, so that yaw is none; expected other 'axes' (\"pitch roll\"), or another way past it");
    if (settings_.axes == Axes::pitch_roll && std::cos(at.roll_rad) < kKeyhole_rad)
      refuse(
          "it is along the axis that pitches, so that pitch is none; expected other 'axes' (\"pan tilt\"), or another way past it");
    for (const GimbalAxis& axis : kGimbalAxes) {
      const double angle = at.*axis.angle;
      const auto& limits = settings_.*axis.limits;
      if (limits && (angle < limits->least_rad || angle > limits->most_rad))
        refuse(format(
            "that needs a {} of {:.4g} deg, and it reaches {:g} to {:g} deg; expected wider limits, another path, or "
            "\"at_limits\": \"stop\"",
            axis.name, angle / kGimbalDegree, limits->least_rad / kGimbalDegree,
            limits->most_rad / kGimbalDegree));
      if (!settings_.rate_rad_s || k == 0) continue;
      const double turned = std::remainder(angle - angles[k - 1].*axis.angle, 2.0 * std::numbers::pi);
      const double rate = std::abs(turned) / (times_s[k] - times_s[k - 1]);
      if (rate > *settings_.rate_rad_s)
        refuse(format("its {} would turn by {:.4g} deg/s, and it turns by at most {:g} deg/s", axis.name,
                      rate / kGimbalDegree, *settings_.rate_rad_s / kGimbalDegree));
    }
  }
}

}  // namespace ifov::platform
