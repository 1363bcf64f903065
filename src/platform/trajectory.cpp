#include "platform/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "platform/bearing.h"
#include "platform/wander.h"

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

CubicSpline straight_spline(math::Point3 at_0_s_m, math::Vec3 velocity_m_s) {
  const math::Point3 p = at_0_s_m, q = at_0_s_m + velocity_m_s;
  return {{0.0, 1.0}, {p.x, p.y, p.z, q.x, q.y, q.z}};
}

double shortest_step(std::span<const PathPoint> path) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < path.size(); ++k) step = std::min(step, path[k].time_s - path[k - 1].time_s);
  return step;
}

math::Vec3 vector_of(const Vec& v) { return {v[0], v[1], v[2]}; }

geodesy::Attitude sum(const geodesy::Attitude& a, double yaw_rad, double pitch_rad, double roll_rad) {
  return {a.yaw_rad + yaw_rad, a.pitch_rad + pitch_rad, a.roll_rad + roll_rad};
}

bool is_zero(const geodesy::Attitude& a) {
  return a.yaw_rad == 0.0 && a.pitch_rad == 0.0 && a.roll_rad == 0.0;
}

void at_circle(const Circle& circle, double time_s, std::span<double, 3> place, std::span<double, 3> slope) {
  const double azimuth = circle.start_rad + circle.rate_rad_s * time_s, east = std::sin(azimuth),
               north = std::cos(azimuth), speed_m_s = circle.radius_m * circle.rate_rad_s;
  place[0] = circle.center_m.x + circle.radius_m * east;
  place[1] = circle.center_m.y + circle.radius_m * north;
  place[2] = circle.center_m.z;
  slope[0] = speed_m_s * north, slope[1] = -speed_m_s * east, slope[2] = 0.0;
}

constexpr int kPartsOfTurn = 16;

double turn_s(const Circle& circle) { return 2.0 * std::numbers::pi / std::abs(circle.rate_rad_s); }

}  // namespace

Trajectory::Trajectory(std::span<const PathPoint> path, const HeldAttitude& attitude)
    : position_(position_spline(path)),
      attitude_(attitude),
      first_s_(path.front().time_s),
      last_s_(path.back().time_s),
      step_s_(shortest_step(path)) {
  for (const PathPoint& point : path) check_stance(point.time_s);
}

Trajectory::Trajectory(std::span<const PathPoint> path, const Pointing& attitude)
    : position_(position_spline(path)),
      attitude_(attitude),
      first_s_(path.front().time_s),
      last_s_(path.back().time_s),
      step_s_(shortest_step(path)) {
  for (const PathPoint& point : path) check_stance(point.time_s);
}

Trajectory::Trajectory(std::span<const PathPoint> path, std::span<const Quaternion> scene_from_body)
    : position_(position_spline(path)),
      attitude_(attitude_spline(path, scene_from_body)),
      first_s_(path.front().time_s),
      last_s_(path.back().time_s),
      step_s_(shortest_step(path)) {}

Trajectory::Trajectory(std::variant<CubicSpline, Circle> position,
                       std::variant<HeldAttitude, Pointing, CubicSpline> attitude, double step_s)
    : position_(std::move(position)),
      attitude_(std::move(attitude)),
      first_s_(-std::numeric_limits<double>::infinity()),
      last_s_(std::numeric_limits<double>::infinity()),
      step_s_(step_s) {
  check_stance(0.0);
}

Trajectory Trajectory::straight(math::Point3 at_0_s_m, math::Vec3 velocity_m_s,
                                const HeldAttitude& attitude) {
  return {straight_spline(at_0_s_m, velocity_m_s), attitude, std::numeric_limits<double>::infinity()};
}

Trajectory Trajectory::straight_pointing(math::Point3 at_0_s_m, math::Vec3 velocity_m_s,
                                         const Pointing& attitude) {
  return {straight_spline(at_0_s_m, velocity_m_s), attitude, std::numeric_limits<double>::infinity()};
}

Trajectory Trajectory::fixed(math::Point3 at_m, const Quaternion& q) {
  const CubicSpline attitude({0.0}, {q.w, q.x, q.y, q.z});
  return {straight_spline(at_m, {}), attitude, std::numeric_limits<double>::infinity()};
}

Trajectory Trajectory::circling(const Circle& circle, const HeldAttitude& attitude) {
  return {circle, attitude, turn_s(circle) / kPartsOfTurn};
}

Trajectory Trajectory::circling(const Circle& circle, const Pointing& attitude) {
  Trajectory trajectory(circle, attitude, turn_s(circle) / kPartsOfTurn);
  constexpr int kChecks = 4 * kPartsOfTurn;
  for (int k = 1; k < kChecks; ++k) trajectory.check_stance(turn_s(circle) * k / kChecks);
  return trajectory;
}

void Trajectory::place_at(double time_s, std::span<double, 3> place_m,
                          std::span<double, 3> velocity_m_s) const {
  if (const auto* circle = std::get_if<Circle>(&position_))
    at_circle(*circle, time_s, place_m, velocity_m_s);
  else
    std::get<CubicSpline>(position_).at(time_s, place_m, velocity_m_s);
}

void Trajectory::check_stance(double time_s) const {
  Vec place{}, slope{};
  place_at(time_s, place, slope);
  if (const auto* held = std::get_if<HeldAttitude>(&attitude_)) {
    if (held->from_track && !(std::hypot(slope[0], slope[1]) > 0.0))
      throw InputError(format(
          "yaw is counted from the track, and at {:g} s the platform does not fly horizontally", time_s));
    return;
  }
  if (!std::holds_alternative<Pointing>(attitude_)) return;
  const Pointing& attitude = std::get<Pointing>(attitude_);
  const auto refuse = [&](const char* why) {
    throw InputError(format("at {:g} s the platform {}", time_s, why));
  };
  const math::Vec3 velocity = vector_of(slope),
                   ahead = attitude.from_track ? velocity : math::Vec3{0.0, 1.0, 0.0};
  const math::Vec3 towards = attitude.target_m
                                 ? *attitude.target_m - math::Point3{place[0], place[1], place[2]}
                                 : math::Vec3{0.0, 0.0, -1.0};
  if (!(math::length(towards) > 0.0)) refuse("is at the point that it looks at");
  if (!(math::length(ahead) > 0.0))
    refuse("stands still, so that its attitude, which follows its velocity, is none");
  if (!(math::length(math::cross(towards, ahead)) > 1e-9 * math::length(towards) * math::length(ahead)))
    refuse(!attitude.target_m
               ? "flies straight up or down along its nose, so that its wings have no direction"
           : attitude.from_track
               ? "flies straight towards the point that it looks at, so that its nose has no direction"
               : "looks straight to the north or south, so that its nose has no direction");
}

Trajectory Trajectory::carrying(Deviation deviation) const {
  Trajectory other = *this;
  if (deviation.motion) other.step_s_ = std::min(step_s_, deviation.motion->step_s());
  for (const Mount& mount : deviation.mounts)
    if (mount.bearing) other.step_s_ = std::min(other.step_s_, mount.bearing->step_s());
  other.deviation_ = std::move(deviation);
  return other;
}

Stance Trajectory::stance(double time_s, math::Point3 position_m, math::Vec3 velocity_m_s) const {
  if (const auto* held = std::get_if<HeldAttitude>(&attitude_)) {
    geodesy::Attitude angles = held->angles;
    if (held->from_track) angles.yaw_rad += std::atan2(velocity_m_s.x, velocity_m_s.y);
    return geodesy::enu_from_body(angles);
  }
  if (const auto* pointing = std::get_if<Pointing>(&attitude_)) {
    const math::Vec3 ahead = pointing->from_track ? velocity_m_s : math::Vec3{0.0, 1.0, 0.0};
    return turned(pointing->target_m ? belly_along(*pointing->target_m - position_m, ahead)
                                     : nose_along(velocity_m_s, {0.0, 0.0, -1.0}),
                  pointing->angles);
  }
  const CubicSpline& spline = std::get<CubicSpline>(attitude_);
  std::array<double, 4> q{};
  spline.at(std::clamp(time_s, spline.first(), spline.last()), q);
  return rotation_of({q[0], q[1], q[2], q[3]});
}

geodesy::Attitude Trajectory::bearing_angles(double time_s, std::size_t mount, const Pose& carrier,
                                             double jitter_share) const {
  const Bearing& bearing = *deviation_->mounts[mount].bearing;
  if (const Trajectory* other = deviation_->read_on.get())
    return other->bearing_angles(time_s, mount, other->carrier(time_s, mount, 1.0), 1.0);
  const double blind = bearing.blind_share();
  if (!(blind > 0.0) || !deviation_->motion) return bearing.angles(time_s, carrier);
  return bearing.angles(time_s, this->carrier(time_s, mount, jitter_share * (1.0 - blind)));
}

Pose Trajectory::carrier(double time_s, std::size_t mount, double jitter_share) const {
  Vec place{}, slope{};
  place_at(time_s, place, slope);
  const math::Vec3 velocity = vector_of(slope);
  const math::Point3 position{place[0], place[1], place[2]};
  Pose pose{position, velocity, stance(time_s, position, velocity)};
  if (!deviation_) return pose;
  geodesy::Attitude turn = deviation_->turn;
  pose.position_m = pose.position_m + deviation_->shift_m;
  if (deviation_->motion) {
    std::array<double, 6> moved{};
    deviation_->motion->at(time_s, moved);
    for (double& one : moved) one *= jitter_share;
    pose.position_m = pose.position_m + math::Vec3{moved[0], moved[1], moved[2]};
    turn = sum(turn, moved[3], moved[4], moved[5]);
  }
  if (!is_zero(turn)) pose.enu_from_body = turned(pose.enu_from_body, turn);
  for (std::size_t k = 0; k < deviation_->mounts.size(); ++k) {
    const Mount& fixed = deviation_->mounts[k];
    pose.position_m = pose.position_m + pose.enu_from_body(geodesy::BodyVector{fixed.lever_arm_m}).v;
    if (!is_zero(fixed.boresight)) pose.enu_from_body = turned(pose.enu_from_body, fixed.boresight);
    if (k == mount) break;
    if (fixed.bearing)
      pose.enu_from_body = turned(pose.enu_from_body, bearing_angles(time_s, k, pose, jitter_share));
  }
  return pose;
}

Pose Trajectory::pose(double time_s) const {
  return carrier(time_s, std::numeric_limits<std::size_t>::max(), 1.0);
}

void Trajectory::check_bearings(std::span<const double> times_s) const {
  if (!deviation_) return;
  for (std::size_t k = 0; k < deviation_->mounts.size(); ++k) {
    if (!deviation_->mounts[k].bearing) continue;
    deviation_->mounts[k].bearing->check(times_s, all_angles(k, times_s));
  }
}

std::vector<std::string> Trajectory::bearings_told(std::span<const double> times_s) const {
  std::vector<std::string> told;
  if (!deviation_) return told;
  for (std::size_t k = 0; k < deviation_->mounts.size(); ++k)
    if (deviation_->mounts[k].bearing)
      told.push_back(deviation_->mounts[k].bearing->told(times_s, all_angles(k, times_s)));
  return told;
}

std::vector<geodesy::Attitude> Trajectory::all_angles(std::size_t mount,
                                                      std::span<const double> times_s) const {
  std::vector<geodesy::Attitude> angles;
  for (const double time_s : times_s)
    angles.push_back(bearing_angles(time_s, mount, carrier(time_s, mount, 1.0), 1.0));
  return angles;
}

}  // namespace ifov::platform
