#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "platform/trajectory.h"
#include "sensor/flying/flying_frame_camera.h"
#include "sensor/lens/distortion.h"
#include "sensor/lens/element_map.h"
#include "sensor/lens/lens_table.h"
#include "sensor/pushbroom_camera.h"

namespace ifov::sensor::test_lens_tables {
namespace {

using Place = Lens::Place;

/// Rows of a lens whose image heights are the angles themselves.
std::shared_ptr<const LensTable> equidistant(int rows) {
  std::vector<LensTable::Row> table;
  for (int k = 1; k <= rows; ++k) table.push_back({1.0 * k / rows, std::atan(1.0 * k / rows)});
  return std::make_shared<const LensTable>(table);
}

TEST(LensTable, GoesThroughItsRowsAndBack) {
  const auto lens = equidistant(20);
  double worst = 0.0;
  for (double r = 0.013; r < 1.0; r += 0.0217) {
    const double c = std::cos(7.0 * r), s = std::sin(7.0 * r);
    const Place at = lens->image_of({r * c, r * s});
    EXPECT_NEAR(at.x * s - at.y * c, 0.0, 1e-15) << "along the radius";
    worst = std::max(worst, std::abs(std::hypot(at.x, at.y) - std::atan(r)));
    const Place back = lens->direction_of(at);
    EXPECT_NEAR(back.x, r * c, 2e-15);
    EXPECT_NEAR(back.y, r * s, 2e-15);
    // dr'/dr times r'/r of the arc tangent.
    EXPECT_NEAR(lens->scale({r * c, r * s}), std::atan(r) / r / (1.0 + r * r), 2e-3);
  }
  EXPECT_LT(worst, 2e-5);
  EXPECT_GT(std::abs(std::hypot(lens->image_of({0.5, 0.0}).x, 0.0) - 0.5), 1e-2) << "planted: a pinhole";
  for (int k = 1; k <= 20; ++k) EXPECT_NEAR(lens->image_of({0.0, k / 20.0}).y, std::atan(k / 20.0), 1e-15);
  // Straight beyond its end, and one row is a scale.
  const double slope = lens->image_of({2.0, 0.0}).x - lens->image_of({1.5, 0.0}).x;
  EXPECT_NEAR(lens->image_of({2.5, 0.0}).x - lens->image_of({2.0, 0.0}).x, slope, 1e-14);
  EXPECT_NEAR(lens->direction_of(lens->image_of({2.5, 0.3})).x, 2.5, 1e-14);
  EXPECT_NEAR(LensTable({{2.0, 1.9}}).image_of({0.7, 0.0}).x, 0.7 * 0.95, 1e-15);
  // Between rows as steep as a stair it stays a stair.
  const LensTable stair({{1.0, 0.1}, {1.1, 2.0}, {3.0, 2.1}});
  double before = 0.0;
  for (double r = 0.01; r < 3.5; r += 0.01) {
    const double now = stair.image_of({r, 0.0}).x;
    EXPECT_GT(now, before);
    before = now;
  }
}

Place parabola(Place at) {
  const auto [x, y] = at;
  return {0.01 + 1.02 * x - 0.03 * y + 0.2 * x * x - 0.1 * x * y + 0.05 * y * y,
          -0.02 + 0.04 * x + 0.97 * y - 0.07 * x * x + 0.15 * x * y + 0.12 * y * y};
}

std::shared_ptr<const ElementMap> frame_map() {
  const std::vector<double> x{-0.5, -0.3, -0.25, 0.0, 0.1, 0.4, 0.5}, y{-0.3, -0.2, 0.05, 0.1, 0.3};
  std::vector<Place> at;
  for (const double v : y)
    for (const double u : x) at.push_back(parabola({u, v}));
  return std::make_shared<const ElementMap>(x, y, at);
}

TEST(ElementMap, IsAParabolaWhereElementsLieOnOne) {
  const auto map = frame_map();
  EXPECT_FALSE(map->first_fold());
  for (double x = -0.5; x <= 0.5; x += 0.0417)
    for (double y = -0.3; y <= 0.3; y += 0.0391) {
      const Place there = map->direction_of({x, y}), wanted = parabola({x, y});
      EXPECT_NEAR(there.x, wanted.x, 1e-15);
      EXPECT_NEAR(there.y, wanted.y, 1e-15);
      const double by = (1.02 + 0.4 * x - 0.1 * y) * (0.97 + 0.15 * x + 0.24 * y) -
                        (-0.03 - 0.1 * x + 0.1 * y) * (0.04 - 0.14 * x + 0.15 * y);
      EXPECT_NEAR(map->area({x, y}), by, 1e-14);
      EXPECT_NEAR(map->scale(there), 1.0 / by, 1e-12);
    }
  for (double x = -0.8; x <= 0.8; x += 0.0917)  // beside the frame, too
    for (double y = -0.5; y <= 0.5; y += 0.0791) {
      const Place back = map->image_of(map->direction_of({x, y}));
      EXPECT_NEAR(back.x, x, 1e-13);
      EXPECT_NEAR(back.y, y, 1e-13);
    }
}

TEST(ElementMap, ThatFoldsSaysWhere) {
  const std::vector<double> x{0.0, 0.1, 0.2, 0.3, 0.4};
  std::vector<Place> at;
  for (const double u : x) at.push_back({u, 0.0});
  EXPECT_FALSE(ElementMap(x, {0.0}, at).first_fold());
  std::swap(at[2], at[3]);
  ASSERT_TRUE(ElementMap(x, {0.0}, at).first_fold());
  EXPECT_NEAR(static_cast<double>(*ElementMap(x, {0.0}, at).first_fold()), 2.0, 1.0);
}

/// 40 elements whose line is bent by a pixel and a half, some of them set aside.
std::shared_ptr<const ElementMap> bent_line(double step) {
  std::vector<double> x;
  std::vector<Place> at;
  for (int k = 0; k < 40; ++k) {
    const double u = (k - 19.5) * step;
    x.push_back(u);
    at.push_back({1.05 * u + step * 0.2 * std::sin(0.9 * k), step * 1.5 * std::pow((k - 19.5) / 19.5, 2.0)});
  }
  return std::make_shared<const ElementMap>(x, std::vector<double>{0.0}, at);
}

std::shared_ptr<const platform::Trajectory> rolling() {
  std::vector<platform::PathPoint> path;
  std::vector<platform::Quaternion> attitudes;
  for (int k = -100; k <= 500; ++k) {
    const double t = 0.01 * k, turn = 2.0 * std::numbers::pi * t / 0.8;
    path.push_back({t, {0.3 * std::sin(turn) + 4.0 * t, 50.0 * t, 1000.0 + t}});
    attitudes.push_back(platform::quaternion_of(
        geodesy::enu_from_body({2e-3 * std::cos(turn), 2e-4 * std::cos(1.3 * turn), 1e-3 * std::sin(turn)})));
  }
  return std::make_shared<const platform::Trajectory>(path, attitudes);
}

void expect_round_trip(const Camera& camera, double far_m, double lines_beside, double tolerance_px) {
  for (double y = 0.37 - lines_beside; y < camera.height_px() + lines_beside; y += 7.3)
    for (double x = -3.0; x < camera.width_px() + 3; x += 2.7) {
      const math::Ray ray = camera.ray({x, y});
      for (const double along_m : {0.37 * far_m, far_m}) {
        sampling::FocalPoint back;
        ASSERT_TRUE(camera.project(ray.origin_m + ray.direction * along_m, back)) << x << " " << y;
        EXPECT_NEAR(back.x_px, x, tolerance_px);
        EXPECT_NEAR(back.y_px, y, tolerance_px);
      }
    }
}

/// The pixel's area across its line of sight, by the rays about it.
double side_by_rays(const Camera& camera, double x, double y, double far_m) {
  const math::Ray middle = camera.ray({x, y});
  const math::Point3 at = middle.origin_m + middle.direction * far_m;
  const math::Vec3 across = camera.pose(y).axes.forward;
  const auto met = [&](double u, double v) {
    const math::Ray ray = camera.ray({u, v});
    return ray.origin_m +
           ray.direction * (math::dot(at - ray.origin_m, across) / math::dot(ray.direction, across));
  };
  constexpr double kHalf = 0.5;
  return std::sqrt(math::length(
      math::cross(met(x + kHalf, y) - met(x - kHalf, y), met(x, y + kHalf) - met(x, y - kHalf))));
}

TEST(ElementMap, OfALineScannerIsFoundAgain) {
  PushbroomCamera::Settings settings{40, 200, 1e-3, 0.0, 0.0, 0.01, rolling()};
  settings.lens = bent_line(1e-3);
  const PushbroomCamera camera(settings);
  expect_round_trip(camera, 1200.0, 9.0, 1e-9);
  // Where it flies straight, far before the first line and after the last: a plane that is bent is met as well.
  for (const double y : {-150.0, 400.0}) {
    const math::Ray ray = camera.ray({37.0, y});
    sampling::FocalPoint back;
    ASSERT_TRUE(camera.project(ray.origin_m + ray.direction * 1100.0, back));
    EXPECT_NEAR(back.x_px, 37.0, 1e-8);
    EXPECT_NEAR(back.y_px, y, 1e-8);
  }
  // The first element looks ahead by 1.5 pixels of 1 m, the one in the middle nowhere.
  const auto ahead = [&](double x) {
    const math::Ray ray = camera.ray({x, 100.5});
    return math::dot(ray.direction, camera.pose(100.5).axes.down) /
           math::dot(ray.direction, camera.pose(100.5).axes.forward);
  };
  EXPECT_NEAR(ahead(0.5), 1.5e-3, 1e-12);
  EXPECT_NEAR(ahead(20.0), 0.0, 1e-5);
  for (const double x : {0.5, 13.2, 39.4}) {
    const math::Ray ray = camera.ray({x, 71.3});
    const double side = side_by_rays(camera, x, 71.3, 1000.0);
    EXPECT_NEAR(camera.gsd_m(ray.origin_m + ray.direction * 1000.0), side, 2e-3 * side);
  }
}

TEST(Distortion, OfALineScannerIsFoundAgain) {
  PushbroomCamera::Settings settings{40, 200, 1e-2, 0.0, 0.0, 0.01, rolling()};
  const Distortion::Terms terms{-0.3, 0.1, 0.0, 0.02, 0.01};
  settings.lens = std::make_shared<const Distortion>(terms, 0.2);
  const PushbroomCamera camera(settings);
  expect_round_trip(camera, 1200.0, 9.0, 1e-9);
  // A direction's image lies on the line: the tangential term p1 has it look ahead by less than nothing.
  const math::Ray ray = camera.ray({40.0, 100.0});
  const CameraPose pose = camera.pose(100.0);
  const double depth = math::dot(ray.direction, pose.axes.forward),
               x = math::dot(ray.direction, pose.axes.right) / depth,
               y = math::dot(ray.direction, pose.axes.down) / depth;
  const double s = x * x + y * y, radial = 1.0 + terms.k1 * s + terms.k2 * s * s;
  EXPECT_NEAR(x * radial + 2.0 * terms.p1 * x * y + terms.p2 * (s + 2.0 * x * x), 0.2, 1e-14);
  EXPECT_NEAR(y * radial + terms.p1 * (s + 2.0 * y * y) + 2.0 * terms.p2 * x * y, 0.0, 1e-14);
  EXPECT_LT(y, -5e-4);
  settings.lens = std::make_shared<const Distortion>(Distortion::Terms{-20.0, 0.0, 0.0, 0.0, 0.0}, 0.2);
  EXPECT_THROW(PushbroomCamera{settings}, InputError);
}

TEST(Lens, OfAFrameThatFliesIsFoundAgain) {
  for (const double row_period_s : {0.0, 2e-3})
    for (const std::shared_ptr<const Lens>& lens :
         {std::shared_ptr<const Lens>(
              std::make_shared<const Distortion>(Distortion::Terms{-0.3, 0.1, 0.0, 0.02, -0.01}, 0.6)),
          std::shared_ptr<const Lens>(equidistant(12)), std::shared_ptr<const Lens>(frame_map())}) {
      FlyingFrameCamera::Settings settings{100, 60, 0.01, 1e-4, 0.0, row_period_s, rolling()};
      settings.lens = lens;
      const FlyingFrameCamera camera(settings);
      expect_round_trip(camera, 1200.0, 0.0, 1e-8);
      const math::Ray ray = camera.ray({12.3, 50.5});
      const CameraPose pose = camera.pose(50.5);
      const double depth = math::dot(ray.direction, pose.axes.forward);
      const Place wanted = lens->direction_of({(12.3 - 50.0) / 100.0, (50.5 - 30.0) / 100.0});
      EXPECT_NEAR(math::dot(ray.direction, pose.axes.right) / depth, wanted.x, 1e-13);
      EXPECT_NEAR(math::dot(ray.direction, pose.axes.down) / depth, wanted.y, 1e-13);
      if (row_period_s > 0.0) continue;
      const double side = side_by_rays(camera, 12.3, 50.5, 900.0);
      EXPECT_NEAR(camera.gsd_m(ray.origin_m + ray.direction * 900.0), side, 2e-3 * side);
    }
}

}  // namespace
}  // namespace ifov::sensor::test_lens_tables
