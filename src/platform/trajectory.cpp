#include "platform/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/format.h"

namespace ifov::platform {
namespace {

using Vec = std::array<double, 3>;

CubicSpline position_spline(std::span<const PathPoint> path) {
  if (path.empty()) throw InputError("a path without points");
  std::vector<double> times, values;
  for (const PathPoint& point : path) {
    const math::Point3 p = point.position_m;
    if (!std::isfinite(point.time_s) || !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError("a path with a number that is not finite");
    if (!times.empty() && !(point.time_s > times.back()))
      throw InputError(
          format("a path whose times do not increase: {:g} s after {:g} s", point.time_s, times.back()));
    times.push_back(point.time_s);
    values.insert(values.end(), {p.x, p.y, p.z});
  }
  return {std::move(times), std::move(values)};
}

CubicSpline attitude_spline(std::span<const PathPoint> path, std::span<const Quaternion> attitudes) {
  std::vector<double> times, values;
  Quaternion before;
  for (std::size_t k = 0; k < path.size(); ++k) {
    Quaternion q = attitudes[k];
    // q and -q are the same rotation: the one that is nearer to the last.
    const double along = before.w * q.w + before.x * q.x + before.y * q.y + before.z * q.z;
    if (k > 0 && along < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
    times.push_back(path[k].time_s);
    values.insert(values.end(), {q.w, q.x, q.y, q.z});
    before = q;
  }
  return {std::move(times), std::move(values)};
}

}  // namespace

Trajectory::Trajectory(std::span<const PathPoint> path, const HeldAttitude& attitude)
    : position_(position_spline(path)),
      attitude_(attitude),
      first_s_(path.front().time_s),
      last_s_(path.back().time_s) {
  if (!attitude.from_track) return;
  for (const PathPoint& point : path) {
    Vec place{}, slope{};
    position_.at(point.time_s, place, slope);
    if (!(std::hypot(slope[0], slope[1]) > 0.0))
      throw InputError(
          format("yaw is counted from the track, and at {:g} s the platform does not fly horizontally",
                 point.time_s));
  }
}

Trajectory::Trajectory(std::span<const PathPoint> path, std::span<const Quaternion> scene_from_body)
    : position_(position_spline(path)),
      attitude_(attitude_spline(path, scene_from_body)),
      first_s_(path.front().time_s),
      last_s_(path.back().time_s) {}

Trajectory Trajectory::straight(math::Point3 at_0_s_m, math::Vec3 velocity_m_s,
                                const HeldAttitude& attitude) {
  const std::array<PathPoint, 2> path{{{0.0, at_0_s_m}, {1.0, at_0_s_m + velocity_m_s}}};
  Trajectory trajectory(path, attitude);
  trajectory.last_s_ = std::numeric_limits<double>::infinity();
  trajectory.first_s_ = -trajectory.last_s_;
  return trajectory;
}

Pose Trajectory::pose(double time_s) const {
  Vec place{}, slope{};
  position_.at(time_s, place, slope);
  const math::Vec3 velocity{slope[0], slope[1], slope[2]};
  const auto stand = [&] {
    if (const auto* held = std::get_if<HeldAttitude>(&attitude_)) {
      geodesy::Attitude angles = held->angles;
      if (held->from_track) angles.yaw_rad += std::atan2(velocity.x, velocity.y);
      return geodesy::enu_from_body(angles);
    }
    const CubicSpline& spline = std::get<CubicSpline>(attitude_);
    std::array<double, 4> q{};
    spline.at(std::clamp(time_s, spline.first(), spline.last()), q);
    return rotation_of({q[0], q[1], q[2], q[3]});
  };
  return {{place[0], place[1], place[2]}, velocity, stand()};
}

}  // namespace ifov::platform
