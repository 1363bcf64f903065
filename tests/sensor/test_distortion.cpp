#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "core/error.h"
#include "sensor/frame_camera.h"
#include "sensor/lens/distortion.h"

namespace ifov::sensor::test_distortion {
namespace {

constexpr double kF = 2000.0;  // focal length, pixels
constexpr int kWidth = 1600, kHeight = 1200;

FrameCamera camera(const Distortion::Terms& terms) {
  FrameCamera::Settings settings;
  settings.width_px = kWidth, settings.height_px = kHeight;
  settings.focal_length_m = kF * 5e-6, settings.pitch_m = 5e-6;
  settings.position_m = {1.0, -2.0, 30.0};
  settings.axes = axes_looking_at({1.0, -2.0, 30.0}, {4.0, 9.0, 0.0}, {0.0, 0.0, 1.0});
  settings.lens = std::make_shared<const Distortion>(terms, 0.5 * std::hypot(kWidth, kHeight) / kF);
  return FrameCamera(settings);
}

/// OpenCV's documentation of calib3d, "Detailed Description": fx = fy = f, the principal point in the middle.
void project_points(const Distortion::Terms& d, double x, double y, double& u, double& v) {
  const double r2 = x * x + y * y, r4 = std::pow(r2, 2.0), r6 = std::pow(r2, 3.0);
  const double radial = 1.0 + d.k1 * r2 + d.k2 * r4 + d.k3 * r6;
  const double xx = x * radial + 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x);
  const double yy = y * radial + d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y;
  u = kF * xx + 0.5 * kWidth, v = kF * yy + 0.5 * kHeight;
}

const Distortion::Terms kBarrel{-0.28, 0.11, -0.02, 6e-4, -4e-4}, kPincushion{0.12, 0.03, 0.0, -5e-4, 8e-4};

TEST(Distortion, IsThatOfOpenCv) {
  for (const Distortion::Terms& terms : {kBarrel, kPincushion}) {
    const FrameCamera taken = camera(terms);
    const CameraPose pose = taken.pose(0.0);
    for (double x = -0.36; x <= 0.37; x += 0.09)
      for (double y = -0.27; y <= 0.28; y += 0.09) {
        const double depth = 20.0 + 30.0 * x;
        const math::Point3 at =
            *pose.position_m + (pose.axes.forward + pose.axes.right * x + pose.axes.down * y) * depth;
        sampling::FocalPoint point;
        ASSERT_TRUE(taken.project(at, point));
        double u = 0.0, v = 0.0;
        project_points(terms, x, y, u, v);
        EXPECT_NEAR(point.x_px, u, 1e-9);
        EXPECT_NEAR(point.y_px, v, 1e-9);
        // Planted fault: tangential terms exchanged.
        project_points({terms.k1, terms.k2, terms.k3, terms.p2, terms.p1}, x, y, u, v);
        if (std::abs(x) + std::abs(y) > 0.3) {
          EXPECT_GT(std::hypot(point.x_px - u, point.y_px - v), 0.01);
        }
        // And back: the ray through there meets the point.
        const math::Ray ray = taken.ray(point);
        const math::Vec3 there = math::normalized(at - ray.origin_m);
        EXPECT_LT(math::length(math::cross(ray.direction, there)), 1e-12);
      }
  }
}

TEST(Distortion, RaysGoBackToTheirPixels) {
  for (const Distortion::Terms& terms : {kBarrel, kPincushion}) {
    const FrameCamera taken = camera(terms);
    for (double x = -100.0; x <= kWidth + 100.0; x += 75.0)  // beside the frame, too
      for (double y = -100.0; y <= kHeight + 100.0; y += 75.0) {
        const math::Ray ray = taken.ray({x, y});
        sampling::FocalPoint point;
        ASSERT_TRUE(taken.project(ray.origin_m + ray.direction * 50.0, point));
        EXPECT_NEAR(point.x_px, x, 1e-9);
        EXPECT_NEAR(point.y_px, y, 1e-9);
      }
  }
}

TEST(Distortion, PixelsAreAsLargeAsTheirShareOfThePlane) {
  const FrameCamera taken = camera(kBarrel);
  const CameraPose pose = taken.pose(0.0);
  const double depth = 40.0;
  const auto on_plane = [&](double x, double y) {
    const math::Ray ray = taken.ray({x, y});
    return ray.origin_m + ray.direction * (depth / math::dot(ray.direction, pose.axes.forward));
  };
  for (const auto& [x, y] : {std::pair{800.0, 600.0}, std::pair{120.0, 1000.0}, std::pair{1550.0, 40.0}}) {
    const math::Vec3 a = on_plane(x + 0.5, y) - on_plane(x - 0.5, y),
                     b = on_plane(x, y + 0.5) - on_plane(x, y - 0.5);
    const double side = std::sqrt(math::length(math::cross(a, b)));
    EXPECT_NEAR(taken.gsd_m(on_plane(x, y)), side, 1e-6 * side);
  }
  EXPECT_GT(taken.gsd_m(on_plane(0.0, 0.0)), 1.05 * taken.gsd_m(on_plane(800.0, 600.0)));
}

TEST(Distortion, ThatFoldsBackWithinTheFrameIsRefused) {
  // x (1 - k r^2) rises to r = 1 / sqrt(3 k): for k = 4, 0.2887, where the image is 0.1925, or 385 pixels from the middle.
  try {
    camera({-4.0, 0.0, 0.0, 0.0, 0.0});
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(
        text.find("the lens distortion folds back within the frame: no direction has its image at pixel "),
        std::string::npos)
        << text;
    const std::size_t from = text.find("pixel ") + 6;
    const double x = std::stod(text.substr(from)), y = std::stod(text.substr(text.find(", ", from) + 2));
    EXPECT_NEAR(std::hypot(x - 800.0, y - 600.0), 385.0, 60.0);
  }
  EXPECT_NO_THROW(camera({-0.3, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_THROW(camera({NAN, 0.0, 0.0, 0.0, 0.0}), InputError);
}

}  // namespace
}  // namespace ifov::sensor::test_distortion
