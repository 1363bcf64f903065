#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "geodesy/attitude.h"
#include "sensor/frame_camera.h"
#include "sensor/orthographic_camera.h"
#include "sensor/sinking_scanner.h"

namespace ifov::sensor::test_cameras {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

void expect_near(math::Vec3 a, math::Vec3 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

math::Ray ray_through(const Camera& camera, double x_px, double y_px) { return camera.ray({x_px, y_px}); }

/// Points all over the image and beyond its rim come back from anywhere along their rays.
void expect_round_trip(const Camera& camera, double distance_m, double tolerance_px) {
  std::vector<sampling::FocalPoint> points;
  for (double y = -3.0; y < camera.height_px() + 3; y += 7.3)
    for (double x = -3.0; x < camera.width_px() + 3; x += 5.7) points.push_back({x, y});
  std::vector<math::Ray> rays(points.size());
  camera.rays(points, rays);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(math::length(rays[i].direction), 1.0, 1e-15);
    for (const double t_m : {0.37 * distance_m, distance_m}) {
      sampling::FocalPoint back;
      ASSERT_TRUE(camera.project(rays[i].origin_m + rays[i].direction * t_m, back));
      EXPECT_NEAR(back.x_px, points[i].x_px, tolerance_px);
      EXPECT_NEAR(back.y_px, points[i].y_px, tolerance_px);
    }
  }
}

TEST(OrthographicCamera, ImageXIsEastAndImageYIsSouth) {
  const OrthographicCamera camera({40, 20, 0.5, 100.0, 200.0, 0.0, 50.0});
  const math::Ray corner = ray_through(camera, 0.0, 0.0), last = ray_through(camera, 40.0, 20.0);
  EXPECT_EQ(corner.origin_m, (math::Point3{90.0, 205.0, 50.0}));
  EXPECT_EQ(last.origin_m, (math::Point3{110.0, 195.0, 50.0}));
  EXPECT_EQ(corner.direction, (math::Vec3{0.0, 0.0, -1.0}));
  EXPECT_EQ(camera.ground_grid()->upper_left_m, (math::Point3{90.0, 205.0, 0.0}));
}

TEST(Cameras, SayHowTheyStand) {
  // The image of an orthographic camera is where its grid says, whatever its rotation and the direction of its rays.
  const OrthographicCamera aslant({40, 20, 0.5, 100.0, 200.0, 0.3, 50.0, 40.0 * kDegree, 70.0 * kDegree});
  const GroundGrid grid = *aslant.ground_grid();
  EXPECT_EQ(grid.gsd_m, 0.5);
  EXPECT_EQ(grid.rotation_rad, 0.3);
  const CameraPose pose = aslant.pose(0.5);
  EXPECT_FALSE(pose.position_m) << "its rays are parallel";
  const math::Point3 place =
      grid.upper_left_m + pose.axes.right * (0.5 * 30.0) + pose.axes.down * (0.5 * 6.0);
  sampling::FocalPoint point;
  ASSERT_TRUE(aslant.project(place, point));
  EXPECT_NEAR(point.x_px, 30.0, 1e-9);
  EXPECT_NEAR(point.y_px, 6.0, 1e-9);
  const math::Transform scene_from_image = grid.scene_from_image();
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {7.0, 3.0}, {40.0, 20.0}}) {
    const math::Ray down = ray_through(aslant, x, y);
    expect_near(scene_from_image(math::Point3{x, y, 0.0}) - math::Point3{},
                down.origin_m + down.direction * (50.0 / -down.direction.z) - math::Point3{}, 1e-11);
  }
  const math::Ray ray = ray_through(aslant, 7.0, 3.0);
  EXPECT_NEAR(math::length(ray.direction - pose.axes.forward), 0.0, 1e-12);

  const CameraAxes axes = axes_from_attitude({0.3, 0.1, -0.2});
  const FrameCamera frame({64, 48, 0.05, 1e-5, {1.0, 2.0, 300.0}, axes});
  EXPECT_FALSE(frame.ground_grid());
  EXPECT_EQ(*frame.pose(0.5).position_m, (math::Point3{1.0, 2.0, 300.0}));
  EXPECT_EQ(frame.pose(0.5).focal_length_m, 0.05);
  EXPECT_NEAR(math::length(ray_through(frame, 32.0, 24.0).direction - frame.pose(0.5).axes.forward), 0.0,
              1e-12);
}

TEST(Cameras, ThatStandStillSayTheSameOfAllLines) {
  const OrthographicCamera aslant({40, 20, 0.5, 100.0, 200.0, 0.3, 50.0, 40.0 * kDegree, 70.0 * kDegree});
  const FrameCamera frame({64, 48, 0.05, 1e-5, {1.0, 2.0, 300.0}, axes_from_attitude({0.3, 0.0, 0.0})});
  for (const double line : {0.5, 10.0, 19.5}) {
    EXPECT_FALSE(aslant.pose(line).altitude_m()) << "above all air";
    EXPECT_EQ(*frame.pose(line).altitude_m(), 300.0);
    EXPECT_EQ(frame.pose(line).time_s, 0.0);
    EXPECT_EQ(*aslant.line_gsd_m(line), 0.5);
    EXPECT_EQ(aslant.ifov(line).x_rad, 0.0);
  }
  EXPECT_NEAR(*frame.line_gsd_m(24.0), 300.0 * 1e-5 / 0.05, 1e-12);
  EXPECT_NEAR(*frame.line_gsd_m(24.0, 100.0), 200.0 * 1e-5 / 0.05, 1e-12);
  EXPECT_NEAR(*frame.line_gsd_m(0.5), 300.0 * 1e-5 / 0.05, 1e-12) << "a plane parallel to the image";
  EXPECT_FALSE(frame.line_gsd_m(24.0, 301.0)) << "ground above it";
  const double step = 1e-5 / 0.05;
  EXPECT_NEAR(frame.ifov(24.0).x_rad, 2.0 * std::atan(0.5 * step), 1e-15);
  EXPECT_NEAR(frame.ifov(24.0).y_rad, 2.0 * std::atan(0.5 * step), 1e-15);
  EXPECT_NEAR(frame.ifov(0.5).y_rad, std::atan(24.0 * step) - std::atan(23.0 * step), 1e-14);
  // The time of a point is that of its ray.
  for (const Camera* camera : {static_cast<const Camera*>(&aslant), static_cast<const Camera*>(&frame)}) {
    EXPECT_EQ(camera->ray({3.0, 4.0, 0.25}).time_s, 0.25);
    EXPECT_EQ(camera->middle_ray().time_s, 0.0);
    EXPECT_EQ(camera->middle_ray(7.0).direction,
              ray_through(*camera, 0.5 * camera->width_px(), 7.0).direction);
  }
  EXPECT_NEAR(nadir_angle_rad(aslant.middle_ray()), 40.0 * kDegree, 1e-14);
  EXPECT_NEAR(nadir_angle_rad({{}, {0.0, 0.6, 0.8}}), std::acos(-0.8), 1e-14);
}

TEST(Cameras, ThatMoveSpeakForEachLine) {
  const test::SinkingScanner scanner;
  EXPECT_NEAR(*scanner.pose(0.0).altitude_m(), 1000.0, 1e-12);
  EXPECT_NEAR(*scanner.pose(400.0).altitude_m(), 960.0, 1e-12);
  EXPECT_NEAR(*scanner.line_gsd_m(0.0), 1.0, 1e-12);
  EXPECT_NEAR(*scanner.line_gsd_m(400.0), 0.96, 1e-12);
  EXPECT_NEAR(*scanner.line_gsd_m(400.0, 460.0), 0.5, 1e-12);
  EXPECT_NEAR(scanner.ifov(100.0).x_rad, 1e-3, 1e-15);
  EXPECT_EQ(scanner.ifov(100.0).y_rad, 0.0) << "lines are parallel: motion alone parts them";
  EXPECT_EQ(scanner.middle_ray().time_s, 2.0);
  EXPECT_EQ(scanner.middle_ray(100.0).time_s, 1.0);
  EXPECT_EQ(scanner.middle_ray(100.0).origin_m, (math::Point3{0.0, 80.0, 990.0}));
  EXPECT_EQ(scanner.ray({0.0, 100.0, 0.25}).time_s, 1.25);
}

TEST(Cameras, AGridLiesOverTheWholeImage) {
  const test::SinkingScanner scanner;
  const std::vector<sampling::FocalPoint> points = grid_over(scanner, 5, 2),
                                          wider = grid_over(scanner, 1, 2, 10.0);
  ASSERT_EQ(points.size(), 10u);
  EXPECT_EQ(points[1].x_px, 15.0);
  EXPECT_EQ(points[1].y_px, 100.0);
  EXPECT_EQ(points[9].x_px, 45.0);
  EXPECT_EQ(points[9].y_px, 300.0);
  EXPECT_EQ(wider[1].x_px, 25.0);
  EXPECT_EQ(wider[0].y_px, 95.0);
}

TEST(OrthographicCamera, LooksAslantAtTheSamePixelsOfTheGround) {
  // The sensor stands 40 degrees off the zenith in the east.
  const OrthographicCamera camera({40, 20, 0.5, 100.0, 200.0, 0.0, 50.0, 40.0 * kDegree, 90.0 * kDegree});
  const sampling::FocalPoint point{30.0, 6.0};
  math::Ray ray;
  camera.rays({&point, 1}, {&ray, 1});
  EXPECT_NEAR(ray.origin_m.z, 50.0, 1e-12);
  EXPECT_NEAR(ray.direction.x, -std::sin(40.0 * kDegree), 1e-12);
  EXPECT_NEAR(ray.direction.y, 0.0, 1e-12);
  const math::Point3 ground = ray.origin_m + ray.direction * (50.0 / std::cos(40.0 * kDegree));
  EXPECT_NEAR(ground.x, 105.0, 1e-9);
  EXPECT_NEAR(ground.y, 202.0, 1e-9);
  sampling::FocalPoint image;
  ASSERT_TRUE(camera.project(ray.origin_m + ray.direction * 20.0, image));
  EXPECT_NEAR(image.x_px, point.x_px, 1e-9);
  EXPECT_NEAR(image.y_px, point.y_px, 1e-9);
}

TEST(OrthographicCamera, RotationTurnsTheTopOfTheImageClockwise) {
  const OrthographicCamera camera({40, 20, 0.5, 0.0, 0.0, 90.0 * kDegree, 10.0});
  const math::Ray top = ray_through(camera, 20.0, 0.0);  // the top of the image looks east
  EXPECT_NEAR(top.origin_m.x, 5.0, 1e-12);
  EXPECT_NEAR(top.origin_m.y, 0.0, 1e-12);
}

TEST(OrthographicCamera, ProjectionInvertsRays) {
  expect_round_trip(OrthographicCamera({64, 48, 0.3, 12.0, -7.0, 0.4, 500.0}), 450.0, 1e-11);
  // 500 km from the origin: 1e-4 px are 0.03 mm.
  expect_round_trip(OrthographicCamera({64, 48, 0.3, 5e5, -5e5, 0.4, 800.0}), 700.0, 1e-8);
}

TEST(OrthographicCamera, SeesNothingAboveItsStart) {
  const OrthographicCamera camera({10, 10, 1.0, 0.0, 0.0, 0.0, 30.0});
  sampling::FocalPoint point;
  EXPECT_FALSE(camera.project({0.0, 0.0, 31.0}, point));
  EXPECT_TRUE(camera.project({0.0, 0.0, 29.0}, point));
}

TEST(OrthographicCamera, RefusesNonsense) {
  EXPECT_THROW(OrthographicCamera({0, 10, 1.0, 0, 0, 0, 0}), InputError);
  EXPECT_THROW(OrthographicCamera({10, 10, -1.0, 0, 0, 0, 0}), InputError);
  EXPECT_THROW(OrthographicCamera({10, 10, 1.0, NAN, 0, 0, 0}), InputError);
}

TEST(CameraAxes, LevelFlightLooksDownWithTheNoseAtTheTop) {
  const CameraAxes north = axes_from_attitude({0.0, 0.0, 0.0});
  expect_near(north.right, {1, 0, 0}, 1e-15);
  expect_near(north.down, {0, -1, 0}, 1e-15);
  expect_near(north.forward, {0, 0, -1}, 1e-15);
  const CameraAxes east = axes_from_attitude({90.0 * kDegree, 0.0, 0.0});
  expect_near(east.down, {-1, 0, 0}, 1e-15);   // the top of the image is east
  expect_near(east.right, {0, -1, 0}, 1e-15);  // the right wing points south
}

TEST(CameraAxes, NoseUpLooksForwardAndRightWingDownLooksLeft) {
  const CameraAxes nose_up = axes_from_attitude({0.0, 10.0 * kDegree, 0.0});
  expect_near(nose_up.forward, {0.0, std::sin(10 * kDegree), -std::cos(10 * kDegree)}, 1e-15);
  const CameraAxes right_down = axes_from_attitude({0.0, 0.0, 10.0 * kDegree});
  expect_near(right_down.forward, {-std::sin(10 * kDegree), 0.0, -std::cos(10 * kDegree)}, 1e-15);
}

TEST(CameraAxes, AreRightHandedAndOrthonormal) {
  for (const CameraAxes& a :
       {axes_from_attitude({0.3, -0.2, 1.1}), axes_looking_at({1, 2, 300}, {40, -20, 0}, {0, 1, 0})}) {
    expect_near(math::cross(a.right, a.down), a.forward, 1e-14);
    EXPECT_NEAR(math::dot(a.right, a.down), 0.0, 1e-14);
    EXPECT_NEAR(math::length(a.right), 1.0, 1e-14);
    EXPECT_NEAR(math::length(a.forward), 1.0, 1e-14);
  }
}

TEST(CameraAxes, LookingAtNeedsADirectionAndAnUp) {
  EXPECT_THROW(axes_looking_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0}), InputError);
  EXPECT_THROW(axes_looking_at({0, 0, 10}, {0, 0, 0}, {0, 0, 1}), InputError);
}

FrameCamera::Settings nadir_frame() {
  return {100, 80, 0.05, 10e-6, {0.0, 0.0, 1000.0}, axes_from_attitude({0.0, 0.0, 0.0})};
}

TEST(FrameCamera, GroundSampleDistanceIsHeightTimesPitchOverFocalLength) {
  const FrameCamera camera(nadir_frame());
  EXPECT_NEAR(camera.gsd_m({0, 0, 0}), 0.2, 1e-15);
  sampling::FocalPoint a, b;
  ASSERT_TRUE(camera.project({0.0, 0.0, 0.0}, a));
  ASSERT_TRUE(camera.project({0.2, -0.4, 0.0}, b));
  EXPECT_NEAR(a.x_px, 50.0, 1e-12);
  EXPECT_NEAR(a.y_px, 40.0, 1e-12);
  EXPECT_NEAR(b.x_px - a.x_px, 1.0, 1e-12);  // east is to the right
  EXPECT_NEAR(b.y_px - a.y_px, 2.0, 1e-12);  // south is down
}

TEST(FrameCamera, HalfTheFieldOfViewIsTheArcTangent) {
  const FrameCamera camera(nadir_frame());
  const math::Ray rim = ray_through(camera, 100.0, 40.0);
  EXPECT_NEAR(std::atan2(rim.direction.x, -rim.direction.z), std::atan(50 * 10e-6 / 0.05), 1e-15);
}

TEST(FrameCamera, LooksAtItsTarget) {
  FrameCamera::Settings settings = nadir_frame();
  const math::Point3 target{120.0, -300.0, 15.0};
  settings.axes = axes_looking_at(settings.position_m, target, {0, 0, 1});
  const FrameCamera camera(settings);
  sampling::FocalPoint point, above;
  ASSERT_TRUE(camera.project(target, point));
  EXPECT_NEAR(point.x_px, 50.0, 1e-10);
  EXPECT_NEAR(point.y_px, 40.0, 1e-10);
  ASSERT_TRUE(camera.project(target + math::Vec3{0, 0, 1}, above));
  EXPECT_LT(above.y_px, point.y_px);  // up in the scene is up in the image
  EXPECT_NEAR(above.x_px, point.x_px, 1e-10);
}

TEST(FrameCamera, ProjectionInvertsRays) {
  FrameCamera::Settings settings = nadir_frame();
  settings.axes = axes_from_attitude({1.1, 0.3, -0.2});
  expect_round_trip(FrameCamera(settings), 1200.0, 1e-9);
  settings.position_m = {5e5, 5e5, 3000.0};
  expect_round_trip(FrameCamera(settings), 3000.0, 1e-5);  // a double's step at 500 km is 6e-11 m
}

TEST(FrameCamera, PointsBehindItHaveNoImage) {
  const FrameCamera camera(nadir_frame());
  sampling::FocalPoint point;
  EXPECT_FALSE(camera.project({0.0, 0.0, 1001.0}, point));
  EXPECT_FALSE(camera.project({0.0, 0.0, 1000.0}, point));
}

TEST(FrameCamera, RefusesNonsense) {
  FrameCamera::Settings settings = nadir_frame();
  settings.focal_length_m = 0.0;
  EXPECT_THROW(FrameCamera{settings}, InputError);
  settings = nadir_frame();
  settings.pitch_m = NAN;
  EXPECT_THROW(FrameCamera{settings}, InputError);
}

}  // namespace
}  // namespace ifov::sensor::test_cameras
