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

/// Of a circle's textbook form, and what a ball in an aircraft without slip does: it lies in the middle.
TEST(Trajectory, CirclesAroundAPoint) {
  const double radius_m = 800.0, rate_rad_s = 0.08;
  for (const double right : {1.0, -1.0}) {
    const Circle circle{{10.0, -20.0, 500.0}, radius_m, 40.0 * kDegree, right * rate_rad_s};
    const double bank_rad = right * std::atan(radius_m * rate_rad_s * rate_rad_s / 9.80665);
    const auto trajectory = Trajectory::circling(circle, HeldAttitude{{0.0, 0.0, bank_rad}, true});
    EXPECT_TRUE(std::isinf(trajectory.first_s()) && std::isinf(trajectory.last_s()));
    for (double t = -1e4; t < 1e4; t += 333.3) {
      const Pose pose = trajectory.pose(t);
      const double azimuth = 40.0 * kDegree + right * rate_rad_s * t;
      const math::Point3 expected{10.0 + radius_m * std::sin(azimuth), -20.0 + radius_m * std::cos(azimuth),
                                  500.0};
      EXPECT_LT(length(pose.position_m - expected), 1e-8);
      constexpr double kStep_s = 1e-3;
      const auto at = [&](double s) { return trajectory.pose(t + s).position_m; };
      const math::Vec3 velocity = (at(kStep_s) - at(-kStep_s)) * (0.5 / kStep_s);
      EXPECT_LT(length(pose.velocity_m_s - velocity), 1e-6);
      EXPECT_GT(dot(pose.enu_from_body.x().v, velocity), length(velocity) * (1.0 - 1e-12)) << "the nose";
      // What hangs in the aircraft hangs along gravity less acceleration, which is towards the middle.
      const math::Vec3 towards = math::Point3{10.0, -20.0, 500.0} - pose.position_m;
      const math::Vec3 felt = math::Vec3{0.0, 0.0, -9.80665} - towards * (rate_rad_s * rate_rad_s);
      EXPECT_GT(dot(pose.enu_from_body.z().v, felt), length(felt) * (1.0 - 1e-12)) << "the belly";
      // The other wing down, or the other way around, is found.
      const auto slips = Trajectory::circling(circle, HeldAttitude{{0.0, 0.0, -bank_rad}, true});
      EXPECT_LT(dot(slips.pose(t).enu_from_body.z().v, felt), length(felt) * 0.8);
    }
  }
}

TEST(Trajectory, RefusesCirclesThroughWhatTheyLookAt) {
  const Circle circle{{}, 100.0, 0.0, 0.1};
  EXPECT_NO_THROW(Trajectory::circling(circle, Pointing{math::Point3{0.0, 0.0, -500.0}, {}, true}));
  try {
    Trajectory::circling(circle, Pointing{math::Point3{0.0, 100.0, 0.0}, {}, true});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "at 0 s the platform is at the point that it looks at");
  }
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
