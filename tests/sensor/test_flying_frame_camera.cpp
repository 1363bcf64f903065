#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "platform/trajectory.h"
#include "sensor/camera_axes.h"
#include "sensor/flying/flying_frame_camera.h"
#include "sensor/flying/image_way.h"
#include "sensor/frame_camera.h"

namespace ifov::sensor {
namespace {

using platform::Trajectory;

FlyingFrameCamera::Settings flying(double exposure_s, double row_period_s, geodesy::Attitude angles = {}) {
  FlyingFrameCamera::Settings settings;
  settings.width_px = 40, settings.height_px = 30;
  settings.focal_length_m = 0.05, settings.pitch_m = 5e-5;
  settings.exposure_s = exposure_s, settings.row_period_s = row_period_s;
  settings.platform = std::make_shared<const Trajectory>(
      Trajectory::straight({10.0, -4.0, 300.0}, {20.0, 7.0, -3.0}, {angles}));
  return settings;
}

/// FrameCamera where that is at a time.
FrameCamera still(const FlyingFrameCamera::Settings& s, geodesy::Attitude angles, double time_s) {
  return FrameCamera({s.width_px, s.height_px, s.focal_length_m, s.pitch_m,
                      s.platform->pose(time_s).position_m, axes_from_attitude(angles)});
}

TEST(FlyingFrameCamera, IsAFrameWhereThePlatformIsThen) {
  const geodesy::Attitude angles{0.7, 0.1, -0.2};
  const auto settings = flying(0.01, 0.002, angles);
  const FlyingFrameCamera camera(settings);
  for (const sampling::FocalPoint& p :
       {sampling::FocalPoint{3.2, 0.7, 0.0}, {39.0, 14.99, 0.004}, {12.0, 29.2, -0.005}}) {
    const double time_s = (std::floor(p.y_px) + 0.5 - 15.0) * 0.002 + p.time_s;
    const math::Ray ray = camera.ray(p), expected = still(settings, angles, time_s).ray({p.x_px, p.y_px});
    EXPECT_NEAR(ray.time_s, time_s, 1e-15);
    EXPECT_LT(math::length(ray.direction - expected.direction), 1e-15);
    EXPECT_LT(math::length(ray.origin_m - expected.origin_m), 1e-12);
    const auto row = camera.pictures()->picture(static_cast<int>(p.y_px));
    const math::Ray own = row->ray({p.x_px, p.y_px - std::floor(p.y_px), p.time_s});
    EXPECT_EQ(row->height_px(), 1);
    EXPECT_LT(math::length(ray.direction - own.direction), 1e-15);
    EXPECT_EQ(own.time_s, ray.time_s);
  }
  EXPECT_TRUE(camera.moves_while_exposed());
  EXPECT_EQ(FlyingFrameCamera(flying(0.01, 0.0)).pictures(), nullptr);
}

TEST(FlyingFrameCamera, ProjectsBack) {
  for (const double row_period_s : {0.0, 1e-4, 0.004}) {
    const FlyingFrameCamera camera(flying(0.0, row_period_s, {0.7, 0.1, -0.2}));
    int found = 0;
    for (const double x : {0.3, 17.0, 39.9})
      for (double y = 0.1; y < 30.0; y += 0.7) {
        const math::Ray ray = camera.ray({x, y});
        const math::Point3 place = ray.origin_m + ray.direction * 280.0;
        sampling::FocalPoint at;
        ASSERT_TRUE(camera.project(place, at));
        // What two rows see is in either.
        const math::Ray again = camera.ray(at);
        const double off =
            math::length(math::cross(place - again.origin_m, again.direction)) / 280.0 * 1000.0;
        EXPECT_LT(off, 0.51 * row_period_s / 0.001 * 0.075 + 1e-9) << x << ' ' << y;
        found += off < 1e-6;
      }
    EXPECT_GT(found, 100) << row_period_s;
  }
}

TEST(FlyingFrameCamera, TellsHowFarThePictureMoves) {
  // 21.2 m/s at 300 m: 0.3 m a pixel.
  const auto motion = frame_motion(FlyingFrameCamera(flying(0.01, 0.002)), 0.0);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->exposure_px, std::hypot(20.0, 7.0) * 0.01 / 0.3, 5e-3);
  EXPECT_NEAR(motion->row_px, std::hypot(20.0, 7.0) * 0.002 / 0.3, 1e-3);
  EXPECT_FALSE(frame_motion(still(flying(0, 0), {}, 0.0), 0.0));
}

TEST(FlyingFrameCamera, SaysWhatCannotBe) {
  const auto message = [](const FlyingFrameCamera::Settings& settings) {
    try {
      FlyingFrameCamera camera(settings);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  auto settings = flying(0.01, 0.0);
  const std::vector<platform::PathPoint> points{{-0.002, {0.0, 0.0, 300.0}}, {0.003, {0.1, 0.0, 300.0}}};
  settings.platform = std::make_shared<const Trajectory>(points, platform::HeldAttitude{});
  EXPECT_EQ(
      message(settings),
      "the platform's path covers -0.002 to 0.003 s, and the image is exposed from -0.005 to 0.005 s: 0.003 s too late and 0.002 s too "
      "short");
  settings = flying(-1.0, 0.0);
  EXPECT_EQ(message(settings), "an exposure of -1 s and rows 0 s apart; expected 0 s or more");
}

}  // namespace
}  // namespace ifov::sensor
