#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "platform/trajectory.h"
#include "sampling/pixel_footprint.h"
#include "sensor/psf.h"
#include "sensor/scanning/scan_camera.h"

namespace ifov::sensor::test_scan_camera {
namespace {

using platform::Trajectory;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHeight_m = 1000.0, kSpeed_m_s = 50.0;

std::shared_ptr<const Trajectory> north(const geodesy::Attitude& attitude = {}) {
  return std::make_shared<const Trajectory>(
      Trajectory::straight({0.0, 0.0, kHeight_m}, {0.0, kSpeed_m_s, 0.0}, {attitude}));
}

/// Rolls, pitches and yaws by milliradians, and climbs.
std::shared_ptr<const Trajectory> shaking(double roll_rad = 1e-3) {
  std::vector<platform::PathPoint> path;
  std::vector<platform::Quaternion> attitudes;
  for (int k = -100; k <= 500; ++k) {
    const double t = 0.01 * k, turn = 2.0 * std::numbers::pi * t / 0.8;
    path.push_back({t, {0.3 * std::sin(turn), kSpeed_m_s * t, kHeight_m + t}});
    attitudes.push_back(platform::quaternion_of(geodesy::enu_from_body(
        {2e-3 * std::cos(turn), 1e-3 * std::cos(1.3 * turn), roll_rad * std::sin(turn)})));
  }
  return std::make_shared<const Trajectory>(path, attitudes);
}

/// Ten elements over 10 m, 10 m from sweep to sweep, 100 deg of which 500 samples are taken.
SweepPattern whisk() {
  SweepPattern p;
  p.samples = 500, p.elements = 10, p.sweeps = 8;
  p.cone_rad = 0.5 * std::numbers::pi;
  p.turn_rad = 100.0 * kDegree;
  p.step = 1e-3;
  p.start_s = 0.5, p.period_s = 0.2, p.sweep_s = 0.08;
  return p;
}

SweepPattern cone(SweepPattern::Axis axis) {
  SweepPattern p = whisk();
  p.axis = axis;
  p.cone_rad = 50.0 * kDegree;
  p.turn_rad = 140.0 * kDegree;
  return p;
}

math::Point3 ground(const math::Ray& ray) {
  return ray.origin_m + ray.direction * (ray.origin_m.z / -ray.direction.z);
}

ScanCamera scanner(const SweepPattern& pattern, std::shared_ptr<const Trajectory> platform = north()) {
  return ScanCamera({pattern, std::move(platform)});
}

/// On level ground: samples at H tan(turn) to the left of the track, elements H step / cos(turn) apart along it, at their sample's time.
TEST(ScanCamera, WhiskbroomSweepsThePlaneAcrossTheTrack) {
  const ScanCamera camera = scanner(whisk());
  EXPECT_EQ(camera.width_px(), 500);
  EXPECT_EQ(camera.height_px(), 80);
  for (const double x : {0.0, 100.0, 250.0, 377.5, 500.0})
    for (const double y : {0.5, 4.0, 9.9, 10.1, 55.5}) {
      const int sweep = static_cast<int>(y / 10.0);
      const double turn = (x - 250.0) / 500.0 * 100.0 * kDegree,
                   time_s = 0.5 + 0.2 * sweep + 0.08 * x / 500.0;
      const math::Ray ray = camera.ray({x, y});
      EXPECT_NEAR(ray.time_s, time_s, 1e-14);
      const math::Point3 seen = ground(ray);
      EXPECT_NEAR(seen.x, -kHeight_m * std::tan(turn), 1e-9) << x << " " << y;
      EXPECT_NEAR(seen.y, kSpeed_m_s * time_s + (y - 10.0 * sweep - 5.0) * 1e-3 * kHeight_m / std::cos(turn),
                  1e-9);
    }
  EXPECT_NEAR(camera.ray({100.0, 3.0, 0.01}).time_s, camera.ray({100.0, 3.0}).time_s + 0.01, 1e-15);
  const CameraPose pose = camera.pose(25.0);
  EXPECT_NEAR(pose.time_s, 0.5 + 0.4 + 0.04, 1e-15);
  EXPECT_NEAR(math::length(math::cross(pose.axes.right, pose.axes.down) - pose.axes.forward), 0.0, 1e-15)
      << "not mirrored";
}

/// A pixel grows by 1/cos^2 along the sweep and 1/cos along the track; neighbouring sweeps, which touch in the middle, overlap by what the
/// swath of elements has grown by (the bow-tie).
TEST(ScanCamera, PixelsGrowAndSweepsOverlap) {
  const ScanCamera camera = scanner(whisk());
  for (const double x : {250.0, 300.0, 400.0, 490.0}) {
    const double turn = (x - 250.0) / 500.0 * 100.0 * kDegree, grown = 1.0 / std::cos(turn);
    const double per_sample = 100.0 * kDegree / 500.0;
    const math::Point3 left = ground(camera.ray({x - 1e-3, 5.0})),
                       right = ground(camera.ray({x + 1e-3, 5.0}));
    EXPECT_NEAR((left.x - right.x) / 2e-3, kHeight_m * per_sample * grown * grown, 1e-6);
    const math::Point3 last = ground(camera.ray({x, 10.0 - 1e-9})), next = ground(camera.ray({x, 10.0}));
    EXPECT_NEAR(last.y - next.y, 10.0 * (grown - 1.0), 1e-6) << "overlap";
    const math::Point3 seen = ground(camera.ray({x, 5.0}));
    EXPECT_NEAR(camera.gsd_m(seen), kHeight_m * grown * std::sqrt(per_sample * 1e-3), 1e-4 * grown);
  }
  EXPECT_NEAR(camera.ifov(40.0).y_rad, 1e-3, 1e-9) << "between two sweeps, too";
  EXPECT_NEAR(camera.ifov(5.0).x_rad, 100.0 * kDegree / 500.0, 1e-6);
}

/// MODIS on a sphere: 705 km up, ten elements of 1 km, 110 deg in 1354 samples. Its ground control team has 4.83 km x 2.01 km for the outermost
/// pixels and 2330 km for the swath (Nishihama et al.: MODIS Level 1A Earth Location ATBD, version 3.0, 1997, section 2).
TEST(ScanCamera, ModisPixelsHaveThePublishedSizes) {
  constexpr double kEarth_m = 6371e3, kOrbit_m = 705e3;
  SweepPattern p = whisk();
  p.samples = 1354, p.turn_rad = 110.0 * kDegree, p.step = 1.0 / 705.0;
  p.start_s = 0.0, p.period_s = 1.477, p.sweep_s = 1354 * 333.333e-6;
  const ScanCamera camera = scanner(p, std::make_shared<const Trajectory>(Trajectory::straight(
                                           {0.0, 0.0, kOrbit_m}, {0.0, 6750.0, 0.0}, {})));
  const auto sphere = [&](double x, double y) {
    const math::Ray ray = camera.ray({x, y});
    const math::Vec3 from =
        ray.origin_m - math::Point3{0.0, ray.origin_m.y, -kEarth_m};  // below the platform, as it flies on
    const double b = math::dot(from, ray.direction), c = math::dot(from, from) - kEarth_m * kEarth_m;
    return from + ray.direction * (-b - std::sqrt(b * b - c));
  };
  const math::Vec3 first = sphere(0.0, 5.0), last = sphere(1354.0, 5.0);
  EXPECT_NEAR(kEarth_m * std::acos(math::dot(first, last) / (kEarth_m * kEarth_m)), 2330e3, 2e3);
  EXPECT_NEAR(math::length(sphere(0.0, 5.0) - sphere(1.0, 5.0)), 4.83e3, 20.0);
  EXPECT_NEAR(math::length(sphere(0.5, 4.5) - sphere(0.5, 5.5)), 2.01e3, 10.0);
  EXPECT_NEAR(math::length(sphere(676.5, 5.0) - sphere(677.5, 5.0)), 1e3, 3.0);
}

/// On level ground a circle of H tan(cone) about the point below, at its sample's time; the same zenith angle everywhere.
TEST(ScanCamera, ConesSeeTheGroundAtOneAngle) {
  for (const auto& [axis, sign] : {std::pair{SweepPattern::Axis::belly_looking_ahead, 1.0},
                                   {SweepPattern::Axis::belly_looking_behind, -1.0}}) {
    const ScanCamera camera = scanner(cone(axis));
    for (const double x : {0.0, 125.0, 250.0, 480.0}) {
      const double turn = (x - 250.0) / 500.0 * 140.0 * kDegree,
                   radius_m = kHeight_m * std::tan(50.0 * kDegree);
      const math::Ray ray = camera.ray({x, 25.0});
      EXPECT_NEAR(nadir_angle_rad(ray), 50.0 * kDegree, 1e-12);
      const math::Point3 seen = ground(ray);
      EXPECT_NEAR(seen.x, -radius_m * std::sin(turn), 1e-9);
      EXPECT_NEAR(seen.y, kSpeed_m_s * (0.9 + 0.08 * x / 500.0) + sign * radius_m * std::cos(turn), 1e-9);
      // Elements further along y lie further ahead, whichever way it looks; a pitch of angle is H / cos^2 on the ground.
      const math::Point3 ahead = ground(camera.ray({x, 25.0 + 1e-3}));
      EXPECT_NEAR(math::dot(ahead - seen, math::Vec3{-std::sin(turn), sign * std::cos(turn), 0.0}),
                  sign * 1e-6 * kHeight_m / std::pow(std::cos(50.0 * kDegree), 2), 1e-8);
    }
    const CameraPose pose = camera.pose(25.0);
    EXPECT_NEAR(math::length(math::cross(pose.axes.right, pose.axes.down) - pose.axes.forward), 0.0, 1e-15);
  }
  // The along-track scanning radiometer: a cone of 23.45 deg about an axis tilted by as much looks at the nadir and 46.9 deg ahead.
  SweepPattern p = cone(SweepPattern::Axis::belly_looking_ahead);
  p.cone_rad = 23.45 * kDegree, p.turn_rad = 340.0 * kDegree;
  const ScanCamera tilted = scanner(p, north({0.0, 23.45 * kDegree, 0.0}));
  EXPECT_NEAR(nadir_angle_rad(tilted.ray({250.0, 5.0})), 46.9 * kDegree, 1e-12);
  EXPECT_NEAR(nadir_angle_rad(tilted.ray({250.0 + 500.0 * 180.0 / 340.0, 5.0})), 0.0, 1e-7);
}

void expect_round_trip(const SweepCamera& sweep, double tolerance_px) {
  for (double x = -9.0; x < sweep.width_px() + 9; x += 17.3)
    for (double y = -3.0; y < sweep.height_px() + 3; y += 1.7) {
      const math::Ray ray = sweep.ray({x, y});
      EXPECT_NEAR(math::length(ray.direction), 1.0, 1e-15);
      for (const double along_m : {300.0, 1200.0}) {
        sampling::FocalPoint back;
        ASSERT_TRUE(sweep.project(ray.origin_m + ray.direction * along_m, back)) << x << " " << y;
        EXPECT_NEAR(back.x_px, x, tolerance_px);
        EXPECT_NEAR(back.y_px, y, tolerance_px);
      }
      sampling::FocalPoint behind;
      EXPECT_FALSE(sweep.project(ray.origin_m - ray.direction * 300.0, behind) &&
                   std::abs(behind.x_px - x) < 1.0 && std::abs(behind.y_px - y) < 1.0);
    }
}

TEST(ScanCamera, ProjectsBack) {
  SweepPattern sine = whisk();
  sine.amplitude_rad = 60.0 * kDegree, sine.both_ways = true;
  sine.sweep_s = SweepPattern::sine_sweep_s(sine.turn_rad, sine.amplitude_rad, 0.4);
  for (const SweepPattern& p : {whisk(), sine, cone(SweepPattern::Axis::belly_looking_ahead),
                                cone(SweepPattern::Axis::belly_looking_behind)})
    for (const int number : {0, 5}) expect_round_trip(*scanner(p, shaking()).sweep(number), 1e-9);
  // A hundredth of a period is noticed.
  SweepPattern late = whisk();
  late.start_s += 0.002;
  const auto ray = scanner(late, shaking()).sweep(3)->ray({100.0, 4.0});
  sampling::FocalPoint back;
  ASSERT_TRUE(scanner(whisk(), shaking()).sweep(3)->project(ray.origin_m + ray.direction * 900.0, back));
  EXPECT_GT(std::abs(back.y_px - 4.0), 0.01);
}

/// A place in the overlap is seen by two sweeps; the whole image has it where it is nearest to the middle of one.
TEST(ScanCamera, OnePlaceMayBeInTwoSweeps) {
  const ScanCamera camera = scanner(whisk());
  const math::Point3 place = ground(camera.ray({450.0, 28.5}));
  sampling::FocalPoint own, next, whole;
  ASSERT_TRUE(camera.sweep(2)->project(place, own) && camera.sweep(3)->project(place, next));
  EXPECT_NEAR(own.y_px, 8.5, 1e-9);
  EXPECT_GT(next.y_px, 0.0) << "seen again";
  EXPECT_LT(next.y_px, 10.0);
  ASSERT_TRUE(camera.project(place, whole));
  EXPECT_NEAR(whole.x_px, 450.0, 0.1);
  EXPECT_NEAR(whole.y_px, std::abs(own.y_px - 5.0) < std::abs(next.y_px - 5.0) ? 28.5 : 30.0 + next.y_px,
              1e-9);
}

TEST(ScanCamera, MirrorsTurnEvenlyOrSwing) {
  SweepPattern p = whisk();
  p.amplitude_rad = 70.0 * kDegree, p.both_ways = true;
  const double cycle_s = 2.0 * p.period_s;
  p.sweep_s = SweepPattern::sine_sweep_s(p.turn_rad, p.amplitude_rad, cycle_s);
  const ScanCamera swinging = scanner(p);
  const double middle_s = p.start_s + 0.5 * p.sweep_s;
  for (const double x : {0.0, 60.0, 250.0, 470.0, 500.0})
    for (const int number : {0, 1, 2}) {
      const double time_s = swinging.sweep(number)->time_s(x);
      const double turn = p.amplitude_rad * std::sin(2.0 * std::numbers::pi * (time_s - middle_s) / cycle_s);
      EXPECT_NEAR(turn, (x - 250.0) / 500.0 * p.turn_rad, 1e-12) << x << " " << number;
    }
  p = whisk();
  p.reversed = true;
  EXPECT_NEAR(scanner(p).sweep(1)->time_s(100.0), 0.5 + 0.2 + 0.08 * 0.8, 1e-15);
  p.both_ways = true;
  EXPECT_NEAR(scanner(p).sweep(1)->time_s(100.0), 0.5 + 0.2 + 0.08 * 0.2, 1e-15);
}

/// Along the sweep an element of a width has a response of a box of its exposure and one of its width, as AlongTrack has along the track.
TEST(ScanCamera, ElementsHaveAWidthAlongTheSweep) {
  SweepPattern p = whisk();
  p.turn_rad = 0.5, p.element_px = 1.0, p.exposure = 0.8;
  const AlongTrack along = scanner(p).along_line();
  EXPECT_NEAR(along.element_px, 1e-3 * 500.0 / 0.5, 1e-12);
  EXPECT_EQ(along.exposure_px, 0.8);
  EXPECT_TRUE(scanner(whisk()).along_line().plain());
  const auto swept = make_swept_footprint(nullptr, 1.0, along), down = make_footprint(nullptr, 1.0, along);
  const auto blur = make_gaussian_psf(0.4);
  const auto blurred = make_swept_footprint(blur.get(), 1.0, along),
             blurred_down = make_footprint(blur.get(), 1.0, along);
  for (const double a : {-0.9, -0.3, 0.1, 0.7})
    for (const double b : {-0.45, 0.2, 0.6}) {
      EXPECT_EQ(swept.integral(a, b, a + 0.3, b + 0.2), down.integral(b, a, b + 0.2, a + 0.3));
      EXPECT_EQ(swept.density(a, b), down.density(b, a));
      EXPECT_NEAR(blurred.integral(a, b, a + 0.3, b + 0.2), blurred_down.integral(b, a, b + 0.2, a + 0.3),
                  1e-14);
    }
  // A trapezoid's share of its own sample: its middle 0.2 whole, its flanks of 0.8 that fall from 0.4 wide on.
  EXPECT_NEAR(swept.integral(-0.1, -0.5, 0.1, 0.5), 0.2, 1e-12);
  EXPECT_NEAR(swept.integral(-2.0, -0.5, 2.0, 0.5), 1.0, 1e-12);
}

std::string refusal(const SweepPattern& pattern, std::shared_ptr<const Trajectory> platform = shaking()) {
  try {
    const ScanCamera camera = scanner(pattern, std::move(platform));
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(ScanCamera, SaysWhatCannotBe) {
  SweepPattern p = whisk();
  EXPECT_EQ(refusal(p), "taken");
  p.start_s = 4.0;
  EXPECT_EQ(
      refusal(p),
      "the platform's path covers -1 to 5 s, and the 8 sweeps take from 4 to 5.48 s: it ends 0.48 s too early");
  p = whisk();
  p.sweep_s = 0.3;
  EXPECT_EQ(
      refusal(p),
      "sweeps of 0.3 s every 0.2 s; expected positive durations, and sweeps that end before the next begins");
  p = whisk();
  p.amplitude_rad = 40.0 * kDegree;
  EXPECT_EQ(
      refusal(p),
      "a line of sight that swings by 40 deg to each side cannot sweep over 100 deg; expected an amplitude above half of that");
  // 100 deg in 80 ms are 22 rad/s; rolling by 3 rad in 0.8 s is 24.
  p = whisk();
  EXPECT_NE(
      refusal(p, shaking(3.1))
          .find(
              "the platform turns faster than the sweep, and the same ground would be seen more than once in it"),
      std::string::npos);
  // At 50 m/s a platform moves by 5 cm in 1 ms; of 50 samples a second one takes it a meter.
  p = whisk();
  p.element_px = 1.0;
  EXPECT_EQ(refusal(p, north()), "taken");
  p.samples = 4, p.turn_rad = 4e-3;
  EXPECT_EQ(
      refusal(p, north()),
      "what elements 1 pitches wide see is 0.5 pixels off from what is known of their samples, as the platform moves while they pass; "
      "expected 0.005 pixels at most: a smaller 'element_width', or none");
}

}  // namespace
}  // namespace ifov::sensor::test_scan_camera
