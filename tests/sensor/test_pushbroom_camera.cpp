#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "platform/trajectory.h"
#include "sensor/pushbroom_camera.h"

namespace ifov::sensor::test_pushbroom_camera {
namespace {

using platform::Trajectory;

constexpr double kDegree = std::numbers::pi / 180.0;

std::shared_ptr<const Trajectory> north(double speed_m_s, double height_m) {
  return std::make_shared<const Trajectory>(
      Trajectory::straight({0.0, 0.0, height_m}, {0.0, speed_m_s, 0.0}, {}));
}

/// An aircraft at 1000 m with 1 m pixels across, 0.5 m along, that rolls, pitches and yaws by milliradians.
std::shared_ptr<const Trajectory> jittering(double roll_rad, double pitch_rad) {
  std::vector<platform::PathPoint> path;
  std::vector<platform::Quaternion> attitudes;
  for (int k = -100; k <= 500; ++k) {
    const double t = 0.01 * k, turn = 2.0 * std::numbers::pi * t / 0.8;
    path.push_back({t, {0.3 * std::sin(turn), 50.0 * t, 1000.0 + t}});
    attitudes.push_back(platform::quaternion_of(geodesy::enu_from_body(
        {2e-3 * std::cos(turn), pitch_rad * std::cos(1.3 * turn), roll_rad * std::sin(turn)})));
  }
  return std::make_shared<const Trajectory>(path, attitudes);
}

void expect_round_trip(const PushbroomCamera& camera, double distance_m, double tolerance_px) {
  for (double y = -9.0; y < camera.height_px() + 9; y += 7.3)
    for (double x = -3.0; x < camera.width_px() + 3; x += 5.7) {
      const math::Ray ray = camera.ray({x, y});
      EXPECT_NEAR(math::length(ray.direction), 1.0, 1e-15);
      for (const double along_m : {0.37 * distance_m, distance_m}) {
        sampling::FocalPoint back;
        ASSERT_TRUE(camera.project(ray.origin_m + ray.direction * along_m, back)) << x << " " << y;
        EXPECT_NEAR(back.x_px, x, tolerance_px);
        EXPECT_NEAR(back.y_px, y, tolerance_px);
      }
    }
}

TEST(PushbroomCamera, ScansWhatItFliesOver) {
  // 1 m a line: line y lies at north = y; flying north the image's right is west.
  const PushbroomCamera camera({40, 20, 1e-3, 0.05, 0.0, 0.02, north(50.0, 1000.0)});
  const math::Ray ray = camera.ray({30.0, 7.5, 0.0});
  EXPECT_NEAR(ray.time_s, 0.15, 1e-15);
  EXPECT_NEAR(ray.origin_m.y, 7.5, 1e-12);
  const math::Point3 ground = ray.origin_m + ray.direction * (1000.0 / -ray.direction.z);
  EXPECT_NEAR(ground.x, -10.0, 1e-9);
  EXPECT_NEAR(ground.y, 7.5, 1e-9);
  const CameraPose pose = camera.pose(7.5);
  EXPECT_NEAR(pose.time_s, 0.15, 1e-15);
  EXPECT_EQ(*pose.altitude_m(), 1000.0);
  EXPECT_NEAR(pose.pitch_m, 5e-5, 1e-18);
  EXPECT_NEAR(math::length(math::cross(pose.axes.right, pose.axes.down) - pose.axes.forward), 0.0, 1e-15)
      << "not mirrored";
  EXPECT_NEAR(*camera.line_gsd_m(7.5), 1.0, 1e-9);
  EXPECT_FALSE(camera.ground_grid());
  // A point's own time moves the platform too.
  EXPECT_NEAR(camera.ray({30.0, 7.5, 0.01}).origin_m.y, 8.0, 1e-12);
  EXPECT_NEAR(camera.ray({30.0, 7.5, 0.01}).time_s, 0.16, 1e-15);
}

TEST(PushbroomCamera, ProjectsBack) {
  expect_round_trip(PushbroomCamera({40, 200, 1e-3, 0.0, -1.0, 0.01, north(50.0, 1000.0)}), 1200.0, 1e-9);
  expect_round_trip(PushbroomCamera({40, 200, 1e-3, 0.0, 0.0, 0.01, jittering(1e-3, 2e-4)}), 1200.0, 1e-9);
  // From orbit: 7.5 km/s at 700 km, coordinates with a tenth of a nanometre of rounding over lines of 10 m.
  expect_round_trip(PushbroomCamera({40, 200, 1e-5, 0.0, 0.0, 10.0 / 7500.0, north(7500.0, 7e5)}), 7.1e5,
                    1e-9);
}

/// What is far before the first line or behind the last has its place there, in front of it nothing has.
TEST(PushbroomCamera, ProjectsWhatLiesFarOutside) {
  const PushbroomCamera camera({40, 200, 1e-3, 0.0, 0.0, 0.01, jittering(1e-3, 2e-4)});
  for (const double y : {-5000.0, -300.0, 500.0, 90000.0}) {
    const math::Ray ray = camera.ray({12.0, y});
    sampling::FocalPoint back;
    ASSERT_TRUE(camera.project(ray.origin_m + ray.direction * 900.0, back));
    EXPECT_NEAR(back.y_px, y, 1e-9 * std::abs(y));
    EXPECT_NEAR(back.x_px, 12.0, 1e-6);
    EXPECT_FALSE(camera.project(ray.origin_m - ray.direction * 900.0, back));
  }
}

/// A tenth of a line is noticed: the time of a line that another camera takes at its beginning.
TEST(PushbroomCamera, PlantedShiftOfTimeIsNoticed) {
  const PushbroomCamera right({40, 200, 1e-3, 0.0, 0.0, 0.01, jittering(1e-3, 2e-4)}),
      late({40, 200, 1e-3, 0.0, 0.001, 0.01, jittering(1e-3, 2e-4)});
  const math::Ray ray = late.ray({12.0, 50.0});
  sampling::FocalPoint back;
  ASSERT_TRUE(right.project(ray.origin_m + ray.direction * 900.0, back));
  EXPECT_NEAR(back.y_px, 50.1, 1e-6);
}

TEST(PushbroomCamera, KnowsTheScaleAcrossAndAlong) {
  // 1 m across, 0.5 m along.
  const PushbroomCamera camera({40, 200, 1e-3, 0.0, 0.0, 0.01, north(50.0, 1000.0)});
  EXPECT_NEAR(camera.gsd_m({3.0, 40.0, 0.0}), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(camera.gsd_m({3.0, 40.0, 500.0}), 0.5, 1e-9) << "half as wide, as long";
  EXPECT_NEAR(camera.ifov(10.0).x_rad, 1e-3, 1e-9);
  // Its area by brute force where it leans: 20 degrees of roll and pitch.
  const PushbroomCamera leaning(
      {40, 200, 1e-3, 0.0, 0.0, 0.01,
       std::make_shared<const Trajectory>(Trajectory::straight({0.0, 0.0, 1000.0}, {0.0, 50.0, 0.0},
                                                               {{0.0, 20.0 * kDegree, 20.0 * kDegree}}))});
  const auto ground = [&](double x, double y) {
    const math::Ray ray = leaning.ray({x, y});
    return ray.origin_m + ray.direction * (ray.origin_m.z / -ray.direction.z);
  };
  const math::Vec3 cell =
      math::cross(ground(20.5, 50.0) - ground(19.5, 50.0), ground(20.0, 50.5) - ground(20.0, 49.5));
  const double across_sight = math::length(cell) * std::abs(leaning.ray({20.0, 50.0}).direction.z);
  EXPECT_NEAR(leaning.gsd_m(ground(20.0, 50.0)), std::sqrt(across_sight), 1e-6);
}

std::string refusal(const PushbroomCamera::Settings& settings) {
  try {
    const PushbroomCamera camera(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(PushbroomCamera, SaysWhatAPathDoesNotCover) {
  EXPECT_EQ(
      refusal({40, 400, 1e-3, 0.0, 2.0, 0.01, jittering(0.0, 0.0)}),
      "the platform's path covers -1 to 5 s, and the 400 lines are exposed from 2 to 6 s: it ends 1 s too early");
  EXPECT_EQ(
      refusal({40, 100, 1e-3, 0.0, -1.25, 0.01, jittering(0.0, 0.0)}),
      "the platform's path covers -1 to 5 s, and the 100 lines are exposed from -1.25 to -0.25 s: it begins 0.25 s too late");
  EXPECT_EQ(refusal({40, 600, 1e-3, 0.0, -1.0, 0.01, jittering(0.0, 0.0)}), "taken")
      << "from its first point to its last";
}

TEST(PushbroomCamera, RefusesToSeeTheSameGroundTwice) {
  EXPECT_EQ(
      refusal({40, 400, 1e-3, 0.0, 0.0, 0.01, north(0.0, 1000.0)}),
      "line 1 of the scanner looks 0 m behind line 0: the platform stands still, flies backwards or turns back faster than "
      "it flies, and the same ground would be seen more than once");
  // 1000 m times 20 mrad times 2 pi 1.3 / 0.8 s is 200 m/s, and it flies 50 m/s.
  EXPECT_NE(refusal({40, 400, 1e-3, 0.0, 0.0, 0.01, jittering(0.0, 2e-2)}).find("m behind line"),
            std::string::npos);
  EXPECT_EQ(refusal({40, 400, 1e-3, 0.0, 0.0, 0.01, jittering(2e-2, 0.0)}), "taken")
      << "roll is no matter of lines";
}

}  // namespace
}  // namespace ifov::sensor::test_pushbroom_camera
