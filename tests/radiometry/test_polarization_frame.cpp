#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiometry/polarization_frame.h"

namespace ifov::radiometry::test_polarization_frame {
namespace {

using math::normalized;
using math::Vec3;

constexpr double kPi = std::numbers::pi;

const Vec3 kDirections[] = {normalized({0.3, -0.5, 0.8}),
                            normalized({-0.9, 0.1, -0.2}),
                            {0.0, 0.0, 1.0},
                            {0.0, 0.0, -1.0},
                            {1.0, 0.0, 0.0},
                            normalized({1e-9, 2e-9, -1.0})};

void expect_frame(const PolarizationFrame& frame, Vec3 direction) {
  EXPECT_NEAR(length(frame.x), 1.0, 1e-12);
  EXPECT_NEAR(dot(frame.x, frame.direction), 0.0, 1e-12);
  EXPECT_NEAR(length(frame.direction - direction), 0.0, 1e-12);
  EXPECT_NEAR(dot(cross(frame.x, frame.y()), frame.direction), 1.0, 1e-12);
}

TEST(PolarizationFrame, MeridionalIsTheVerticalPlane) {
  for (const Vec3& k : kDirections) {
    const PolarizationFrame frame = meridional_frame(k);
    expect_frame(frame, k);
    EXPECT_NEAR(frame.y().z, 0.0, 1e-12);
    EXPECT_LE(frame.x.z, 0.0);
    const PolarizationFrame angles = meridional_frame(k.z, std::atan2(k.y, k.x));
    EXPECT_NEAR(length(frame.x - angles.x), 0.0, 1e-7);
  }
}

TEST(PolarizationFrame, TurningTakesLightAlong) {
  // Light that swings along a fixed line of space does so about every frame.
  const Vec3 k = kDirections[0];
  const PolarizationFrame from = meridional_frame(k);
  const double angle = 0.6;
  const Vec3 line = std::cos(angle) * from.x + std::sin(angle) * from.y();
  const StokesVector s{1.0, std::cos(2.0 * angle), std::sin(2.0 * angle), 0.0};
  for (const double turn : {0.2, 1.9, -2.5}) {
    const PolarizationFrame to{k, std::cos(turn) * from.x + std::sin(turn) * from.y()};
    const StokesVector t = turned(from, to) * s;
    EXPECT_NEAR(t.q, 2.0 * std::pow(dot(line, to.x), 2) - 1.0, 1e-12);
    EXPECT_NEAR(t.u, 2.0 * dot(line, to.x) * dot(line, to.y()), 1e-12);
    const StokesVector back = turned(to, from) * t;
    EXPECT_NEAR(back.q, s.q, 1e-12);
    EXPECT_NEAR(back.u, s.u, 1e-12);
  }
  EXPECT_NEAR((turned(from, {k, -from.x}) * s).u, s.u, 1e-12);
}

TEST(PolarizationFrame, CarriedAroundATriangleItTurnsByItsExcess) {
  // An octant of the sphere: three right angles, excess pi / 2.
  const Vec3 a{1.0, 0.0, 0.0}, b{0.0, 1.0, 0.0}, c{0.0, 0.0, 1.0};
  const PolarizationFrame start{a, b};
  expect_frame(carried(start, c), c);
  const PolarizationFrame end = carried(carried(carried(start, b), c), a);
  EXPECT_NEAR(std::atan2(dot(end.x, start.y()), dot(end.x, start.x)), 0.5 * kPi, 1e-12);
  // Along a meridian the vertical plane stays.
  const PolarizationFrame low = meridional_frame(0.2, 0.7), high = meridional_frame(0.9, 0.7);
  EXPECT_NEAR(length(carried(low, high.direction).x - high.x), 0.0, 1e-12);
}

TEST(PolarizationFrame, ScatteringFramesShareTheirPlane) {
  for (const Vec3& before : kDirections)
    for (const Vec3& after : kDirections) {
      const ScatteringFrames frames = scattering_frames(before, after);
      expect_frame(frames.before, before);
      expect_frame(frames.after, after);
      EXPECT_NEAR(length(frames.before.y() - frames.after.y()), 0.0, 1e-12);
      if (length(cross(before, after)) > 1e-6) {
        EXPECT_GT(dot(frames.after.y(), cross(before, after)), 0.0);
      }
    }
}

// Scattering matrices are [a2 = a3] forward and [a2 = -a3] backward, and then every plane tells the same.
TEST(PolarizationFrame, ForwardAndBackwardAreNoJump) {
  const auto in_meridians = [](const MuellerMatrix& m, Vec3 before, Vec3 after) {
    return about(m, scattering_frames(before, after), meridional_frame(before), meridional_frame(after));
  };
  const Vec3 k = normalized({0.4, 0.3, -0.7});
  const Vec3 aside = normalized(cross(k, {0.2, 0.9, 0.1}));
  for (const double side : {1.0, -1.0}) {
    const MuellerMatrix m = MuellerMatrix::diagonal(1.0, 0.8, side * 0.8, side * 0.6);
    const MuellerMatrix exact = in_meridians(m, k, side * k);
    for (const double tilt : {1e-5, 1e-7, 1e-13}) {
      const MuellerMatrix near = in_meridians(m, k, normalized(side * k + tilt * aside));
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column)
          EXPECT_NEAR(near(row, column), exact(row, column), 1e-4) << side << " " << tilt;
    }
    // The planted fault: a matrix that is not of this direction jumps.
    const MuellerMatrix other = MuellerMatrix::diagonal(1.0, 0.8, -side * 0.8, side * 0.6);
    EXPECT_GT(std::abs(in_meridians(other, k, normalized(side * k + 1e-5 * aside))(1, 1) -
                       in_meridians(other, k, side * k)(1, 1)),
              0.01);
  }
}

}  // namespace
}  // namespace ifov::radiometry::test_polarization_frame
