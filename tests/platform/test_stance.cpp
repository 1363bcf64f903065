#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "platform/quaternion.h"
#include "platform/stance.h"
#include "platform/trajectory.h"

namespace ifov::platform {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double apart(const Stance& a, const Stance& b) {
  return length(a.x() - b.x()) + length(a.y() - b.y()) + length(a.z() - b.z());
}

/// Hamilton's product: the rotation q after p in q's own axes.
Quaternion product(const Quaternion& p, const Quaternion& q) {
  return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
          p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
}

/// Half-angle form of the 3-2-1 sequence about z, y, x, from the textbooks.
Quaternion of_angles(const geodesy::Attitude& a) {
  const Quaternion yaw{std::cos(0.5 * a.yaw_rad), 0.0, 0.0, std::sin(0.5 * a.yaw_rad)},
      pitch{std::cos(0.5 * a.pitch_rad), 0.0, std::sin(0.5 * a.pitch_rad), 0.0},
      roll{std::cos(0.5 * a.roll_rad), std::sin(0.5 * a.roll_rad), 0.0, 0.0};
  return product(product(yaw, pitch), roll);
}

void expect_right_handed(const Stance& stance) {
  EXPECT_NEAR(length(cross(stance.x(), stance.y()) - stance.z()), 0.0, 1e-14);
  EXPECT_NEAR(length(stance.x()), 1.0, 1e-14);
  EXPECT_NEAR(dot(stance.x(), stance.y()), 0.0, 1e-14);
}

TEST(Stance, TurnsAboutTheBodysOwnAxes) {
  const geodesy::Attitude angles{0.3, -0.2, 0.7};
  EXPECT_LT(apart(turned(geodesy::enu_from_body({}), angles), geodesy::enu_from_body(angles)), 1e-14);
  const Stance start = geodesy::enu_from_body({2.0, 0.4, -1.0});
  EXPECT_LT(apart(turned(start, angles), rotation_of(product(quaternion_of(start), of_angles(angles)))),
            1e-14);
  EXPECT_GT(apart(turned(start, angles), rotation_of(product(of_angles(angles), quaternion_of(start)))), 0.1)
      << "and not about others";
}

TEST(Stance, TurnsBellyOrNose) {
  EXPECT_LT(apart(belly_along({0.0, 0.0, -3.0}, {0.0, 5.0, 1.0}), geodesy::enu_from_body({})), 1e-15);
  EXPECT_LT(apart(nose_along({2.0, 0.0, 0.0}, {0.0, 0.0, -1.0}),
                  geodesy::enu_from_body({90.0 * kDegree, 0.0, 0.0})),
            1e-15);
  const Stance down = belly_along({1.0, 2.0, -3.0}, {4.0, -1.0, 0.5});
  expect_right_handed(down);
  EXPECT_NEAR(dot(down.z(), normalized(geodesy::EnuVector{{1.0, 2.0, -3.0}})), 1.0, 1e-15);
  EXPECT_NEAR(math::dot(down.y().v, {4.0, -1.0, 0.5}), 0.0, 1e-14);
  EXPECT_GT(math::dot(down.x().v, {4.0, -1.0, 0.5}), 0.0);
}

TEST(Trajectory, LooksAtAPoint) {
  const math::Point3 target{30.0, 400.0, 20.0};
  const auto trajectory =
      Trajectory::straight_pointing({0.0, 0.0, 1000.0}, {0.0, 50.0, 0.0}, {target, {0.0, 0.0, 0.1}, true});
  for (const double t : {-20.0, 0.0, 8.0, 100.0}) {
    const Pose pose = trajectory.pose(t);
    expect_right_handed(pose.enu_from_body);
    const math::Vec3 sight = math::normalized(target - pose.position_m);
    // 0.1 rad of roll about the nose, which the line of sight is square to.
    EXPECT_NEAR(math::dot(pose.enu_from_body.z().v, sight), std::cos(0.1), 1e-14) << t;
    EXPECT_NEAR(math::dot(pose.enu_from_body.x().v, sight), 0.0, 1e-14) << t;
    EXPECT_GT(pose.enu_from_body.x().v.y, 0.0) << t;
  }
}

TEST(Trajectory, PointsItsNoseAlongItsVelocity) {
  const std::vector<PathPoint> path{{0.0, {}}, {1.0, {100.0, 0.0, 20.0}}, {2.0, {190.0, 40.0, 60.0}}};
  const Trajectory trajectory(path, Pointing{});
  for (const double t : {0.0, 0.7, 1.9}) {
    const Pose pose = trajectory.pose(t);
    expect_right_handed(pose.enu_from_body);
    EXPECT_NEAR(math::dot(pose.enu_from_body.x().v, math::normalized(pose.velocity_m_s)), 1.0, 1e-14);
    EXPECT_NEAR(pose.enu_from_body.y().v.z, 0.0, 1e-15) << "wings level";
    EXPECT_LT(pose.enu_from_body.z().v.z, 0.0) << "belly down";
  }
}

TEST(Trajectory, RefusesToPointWhereNothingIs) {
  const auto said = [](math::Vec3 velocity, const Pointing& pointing) -> std::string {
    try {
      Trajectory::straight_pointing({0.0, 0.0, 500.0}, velocity, pointing);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_EQ(said({0.0, 9.0, 0.0}, {}), "taken");
  EXPECT_EQ(said({}, {}),
            "at 0 s the platform stands still, so that its attitude, which follows its velocity, is none");
  EXPECT_EQ(
      said({0.0, 0.0, 9.0}, {}),
      "at 0 s the platform flies straight up or down along its nose, so that its wings have no direction");
  EXPECT_EQ(said({0.0, 9.0, 0.0}, {math::Point3{0.0, 0.0, 500.0}}),
            "at 0 s the platform is at the point that it looks at");
  EXPECT_EQ(
      said({0.0, 9.0, 0.0}, {math::Point3{0.0, 100.0, 500.0}}),
      "at 0 s the platform flies straight towards the point that it looks at, so that its nose has no direction");
  EXPECT_EQ(said({0.0, 9.0, 0.0}, {math::Point3{0.0, 100.0, 500.0}, {}, false}),
            "at 0 s the platform looks straight to the north or south, so that its nose has no direction");
}

TEST(Trajectory, CarriesWhatIsMountedOnIt) {
  const HeldAttitude held{{0.4, 0.1, -0.2}, false};
  const auto path = Trajectory::straight({1.0, 2.0, 300.0}, {0.0, 50.0, 0.0}, held);
  const Mount mount{{2.0, -0.5, 1.0}, {0.01, -0.02, 0.03}};
  const Trajectory carried =
      path.carrying({.shift_m = {0.1, 0.2, 0.3}, .turn = {0.0, 0.05, 0.0}, .mounts = {mount}});
  const Pose bare = path.pose(3.0), pose = carried.pose(3.0);
  const Quaternion body = product(of_angles(held.angles), of_angles({0.0, 0.05, 0.0}));
  // In north-east-down, as the angles are told.
  const auto rotate = [](const Quaternion& q, math::Vec3 v) {
    const Quaternion turned = product(product(q, {0.0, v.x, v.y, v.z}), {q.w, -q.x, -q.y, -q.z});
    return math::Vec3{turned.y, turned.x, -turned.z};
  };
  EXPECT_LT(math::length(pose.position_m -
                         (bare.position_m + math::Vec3{0.1, 0.2, 0.3} + rotate(body, mount.lever_arm_m))),
            1e-12);
  const Quaternion camera = product(body, of_angles(mount.boresight));
  EXPECT_LT(math::length(pose.enu_from_body.x().v - rotate(camera, {1.0, 0.0, 0.0})), 1e-14);
  EXPECT_LT(math::length(pose.enu_from_body.z().v - rotate(camera, {0.0, 0.0, 1.0})), 1e-14);
  EXPECT_GT(math::length(pose.enu_from_body.z().v -
                         rotate(product(of_angles(mount.boresight), body), {0.0, 0.0, 1.0})),
            1e-3)
      << "the order matters";
  EXPECT_EQ(carried.step_s(), path.step_s());
}

}  // namespace
}  // namespace ifov::platform
