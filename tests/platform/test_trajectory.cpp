#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "platform/quaternion.h"
#include "platform/trajectory.h"

namespace ifov::platform::test_trajectory {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double apart(const geodesy::FrameTransform<geodesy::Enu, geodesy::Body>& a,
             const geodesy::FrameTransform<geodesy::Enu, geodesy::Body>& b) {
  return length(a.x() - b.x()) + length(a.y() - b.y()) + length(a.z() - b.z());
}

TEST(Quaternion, IsTheRotationThatItIsMadeOf) {
  for (double yaw = -180.0; yaw <= 180.0; yaw += 37.0)
    for (double pitch = -90.0; pitch <= 90.0; pitch += 45.0)
      for (double roll = -180.0; roll <= 180.0; roll += 45.0) {
        const auto rotation = geodesy::enu_from_body({yaw * kDegree, pitch * kDegree, roll * kDegree});
        const Quaternion q = quaternion_of(rotation);
        EXPECT_NEAR(length(q), 1.0, 1e-15);
        EXPECT_LT(apart(rotation_of(q), rotation), 1e-14) << yaw << " " << pitch << " " << roll;
      }
  // A quarter turn about z, by its textbook form: x to y.
  const auto turned = rotation_of({std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)});
  EXPECT_NEAR(turned.x().v.y, 1.0, 1e-15);
  EXPECT_NEAR(turned.y().v.x, -1.0, 1e-15);
}

TEST(Trajectory, FliesStraight) {
  const auto trajectory = Trajectory::straight({1.0, 2.0, 300.0}, {3.0, -4.0, 0.5}, {{0.1, 0.2, 0.3}, false});
  const Pose pose = trajectory.pose(-10.0);
  EXPECT_NEAR(length(pose.position_m - math::Point3{-29.0, 42.0, 295.0}), 0.0, 1e-12);
  EXPECT_NEAR(length(pose.velocity_m_s - math::Vec3{3.0, -4.0, 0.5}), 0.0, 1e-13);
  EXPECT_LT(apart(pose.enu_from_body, geodesy::enu_from_body({0.1, 0.2, 0.3})), 1e-15);
  EXPECT_TRUE(std::isinf(trajectory.last_s()));
}

TEST(Trajectory, CountsYawFromTheTrack) {
  const auto trajectory = Trajectory::straight({}, {50.0, 50.0, 5.0}, {{10.0 * kDegree, 0.0, 0.0}, true});
  EXPECT_LT(apart(trajectory.pose(7.0).enu_from_body, geodesy::enu_from_body({55.0 * kDegree, 0.0, 0.0})),
            1e-14);
  EXPECT_THROW(Trajectory::straight({}, {0.0, 0.0, 5.0}, {{}, true}), InputError);
}

TEST(Trajectory, GoesSmoothlyThroughPointsAndAttitudes) {
  // A circle, the nose along it: 16 points a turn.
  std::vector<PathPoint> path;
  std::vector<Quaternion> attitudes;
  const auto place = [](double t) { return math::Point3{1000.0 * std::sin(t), 1000.0 * std::cos(t), 500.0}; };
  const auto stand = [](double t) { return geodesy::enu_from_body({0.5 * std::numbers::pi + t, 0.0, 0.2}); };
  for (int k = 0; k <= 40; ++k) {
    const double t = k * std::numbers::pi / 8.0;
    path.push_back({t, place(t)});
    attitudes.push_back(quaternion_of(stand(t)));  // of w >= 0: signs flip on the way
  }
  const Trajectory trajectory(path, attitudes);
  for (double t = 1.0; t < 14.0; t += 0.0713) {
    const Pose pose = trajectory.pose(t);
    EXPECT_NEAR(length(pose.position_m - place(t)), 0.0, 0.4) << "5/384 h^4 of 1000 m is 0.31 m";
    EXPECT_LT(apart(pose.enu_from_body, stand(t)), 2e-4);
  }
  EXPECT_EQ(trajectory.first_s(), 0.0);
  // Attitudes are kept beyond the ends.
  EXPECT_LT(apart(trajectory.pose(-3.0).enu_from_body, stand(0.0)), 1e-12);
}

TEST(Trajectory, RefusesTimesThatDoNotIncrease) {
  const std::vector<PathPoint> path{{0.0, {}}, {1.0, {}}, {1.0, {}}};
  try {
    Trajectory(path, HeldAttitude{});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a path whose times do not increase: 1 s after 1 s");
  }
}

}  // namespace
}  // namespace ifov::platform::test_trajectory
