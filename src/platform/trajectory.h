#pragma once

#include <span>
#include <variant>
#include <vector>

#include "geodesy/attitude.h"
#include "platform/cubic_spline.h"
#include "platform/quaternion.h"

namespace ifov::platform {

/// Where a platform is at an instant and how it stands, scene frame (ENU metres).
struct Pose {
  math::Point3 position_m;
  math::Vec3 velocity_m_s;
  geodesy::FrameTransform<geodesy::Enu, geodesy::Body> enu_from_body;  ///< a rotation alone
};

/// Angles of a platform that holds them.
struct HeldAttitude {
  geodesy::Attitude angles;
  /// Whether yaw is counted from where the platform flies to, horizontally, instead of from north.
  bool from_track = false;
};

/// A point of a path: seconds after the document's instant, scene frame.
struct PathPoint {
  double time_s = 0.0;
  math::Point3 position_m;
};

/// Position and attitude of a platform over time. Between its points both are smooth (CubicSpline); attitudes are
/// interpolated as the components of their quaternions, scaled to length 1. Beyond its points it flies on straight
/// and keeps its attitude. Any number of threads may ask.
class Trajectory {
 public:
  /// Through points in the order of their times; a single one stands still. ifov::InputError where times do not increase, a number is not
  /// finite, or a yaw is counted from the track of what does not fly horizontally.
  Trajectory(std::span<const PathPoint> path, const HeldAttitude& attitude);
  /// The same with an attitude for each point.
  Trajectory(std::span<const PathPoint> path, std::span<const Quaternion> scene_from_body);

  static Trajectory straight(math::Point3 at_0_s_m, math::Vec3 velocity_m_s, const HeldAttitude& attitude);

  Pose pose(double time_s) const;

  /// What its points cover; of what flies straight all times.
  double first_s() const { return first_s_; }
  double last_s() const { return last_s_; }

 private:
  CubicSpline position_;
  std::variant<HeldAttitude, CubicSpline> attitude_;  // of quaternions
  double first_s_ = 0.0, last_s_ = 0.0;
};

}  // namespace ifov::platform
