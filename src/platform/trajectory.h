#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "geodesy/attitude.h"
#include "platform/cubic_spline.h"
#include "platform/quaternion.h"
#include "platform/stance.h"

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

/// Of a platform that turns by itself: the belly towards a point, or the nose along its velocity with the belly as far down as that leaves.
struct Pointing {
  std::optional<math::Point3> target_m = {};  ///< scene frame; none: the nose along the velocity
  geodesy::Attitude angles = {};              ///< about the axes that follow from that (turned)
  /// With a target: whether the nose is as near to the velocity as that leaves, instead of to north.
  bool from_track = true;
};

/// Around a vertical axis, at one height and speed.
struct Circle {
  math::Point3 center_m;  ///< at the height of the path
  double radius_m = 0.0;
  double start_rad = 0.0;   ///< from the center to the platform at 0 s: clockwise from north
  double rate_rad_s = 0.0;  ///< of this angle: above 0 to the right
};

class Bearing;
class Trajectory;
class Wander;

/// How something is fixed to a body: where, along the body's nose, right wing and belly, and how it is turned against them.
struct Mount {
  math::Vec3 lever_arm_m;
  geodesy::Attitude boresight;
  std::shared_ptr<const Bearing> bearing = nullptr;  ///< turns it from there; null: it is fixed
};

/// What lies between a path with its attitudes and what it carries, in this order.
struct Deviation {
  math::Vec3 shift_m = {};      ///< of the position: east, north, up
  geodesy::Attitude turn = {};  ///< about the body's own axes
  /// Added to both: east, north, up (m), yaw, pitch, roll (rad); null: nothing.
  std::shared_ptr<const Wander> motion = nullptr;
  std::vector<Mount> mounts = {};  ///< each on the one before
  /// On which bearings have the angles that they have here: what is said of a pose knows angles as they are. Null: here.
  std::shared_ptr<const Trajectory> read_on = nullptr;
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
  /// InputError, too, where at a point the direction that it turns to is none: without velocity, at the target, flying straight up or
  /// towards the target.
  Trajectory(std::span<const PathPoint> path, const Pointing& attitude);
  /// The same with an attitude for each point.
  Trajectory(std::span<const PathPoint> path, std::span<const Quaternion> scene_from_body);

  static Trajectory straight(math::Point3 at_0_s_m, math::Vec3 velocity_m_s, const HeldAttitude& attitude);
  static Trajectory straight_pointing(math::Point3 at_0_s_m, math::Vec3 velocity_m_s,
                                      const Pointing& attitude);

  static Trajectory fixed(math::Point3 at_m, const Quaternion& scene_from_body);
  static Trajectory circling(const Circle& circle, const HeldAttitude& attitude);
  static Trajectory circling(const Circle& circle, const Pointing& attitude);

  /// The same path, of what it carries; once at most. The velocity stays that of the path.
  Trajectory carrying(Deviation deviation) const;

  Pose pose(double time_s) const;

  /// Throws InputError where a bearing cannot do at these times, which increase, what it is for.
  void check_bearings(std::span<const double> times_s) const;

  /// What its bearings say of their angles at these times, in the order of the mounts.
  std::vector<std::string> bearings_told(std::span<const double> times_s) const;

  /// The shortest time between the points that it passes smoothly, or in which it turns by 1/16 of a circle; infinite where one velocity
  /// holds.
  double step_s() const { return step_s_; }

  /// What its points cover; of what flies straight or in circles all times.
  double first_s() const { return first_s_; }
  double last_s() const { return last_s_; }

 private:
  /// At all times.
  Trajectory(std::variant<CubicSpline, Circle> position,
             std::variant<HeldAttitude, Pointing, CubicSpline> attitude, double step_s);
  void place_at(double time_s, std::span<double, 3> place_m, std::span<double, 3> velocity_m_s) const;
  /// InputError where the attitude is none at an instant.
  void check_stance(double time_s) const;
  Stance stance(double time_s, math::Point3 position_m, math::Vec3 velocity_m_s) const;
  /// Of what the mount with this number turns; of all, the whole.
  Pose carrier(double time_s, std::size_t mount, double jitter_share) const;
  std::vector<geodesy::Attitude> all_angles(std::size_t mount, std::span<const double> times_s) const;
  geodesy::Attitude bearing_angles(double time_s, std::size_t mount, const Pose& carrier,
                                   double jitter_share) const;

  std::variant<CubicSpline, Circle> position_;
  std::variant<HeldAttitude, Pointing, CubicSpline> attitude_;  // of quaternions
  std::optional<Deviation> deviation_;
  double first_s_ = 0.0, last_s_ = 0.0, step_s_ = 0.0;
};

}  // namespace ifov::platform
