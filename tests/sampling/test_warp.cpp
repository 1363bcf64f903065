#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sampling/sequence.h"
#include "sampling/warp.h"
#include "support/statistics.h"

namespace ifov::sampling::test_warp {
namespace {

using math::Vec3;
using std::numbers::pi;
constexpr double kDegree = pi / 180.0;
constexpr double kSunHalfAngle = 0.2666 * kDegree;

Vec3 tilted(double zenith_rad, double azimuth_rad) {
  return {std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
          std::cos(zenith_rad)};
}

double disk_p_value(Point2 (*warp)(Point2)) {
  std::vector<double> observed(8 * 16, 0.0);
  for (int k = 0; k < 100000; ++k) {
    const Point2 p = warp({unit_double(hash(5, k, 0)), unit_double(hash(5, k, 1))});
    const int ring = std::min(7, static_cast<int>((p.x * p.x + p.y * p.y) * 8.0));
    const int sector = std::min(15, static_cast<int>((std::atan2(p.y, p.x) / (2 * pi) + 0.5) * 16.0));
    observed[static_cast<std::size_t>(ring * 16 + sector)] += 1.0;
  }
  return test::chi_square_test(observed, std::vector<double>(128, 100000.0 / 128));
}

TEST(UniformDisk, FillsTheDiskEvenly) { EXPECT_GT(disk_p_value(uniform_disk), 1e-4); }

TEST(UniformDisk, SquareRootForgottenIsCaught) {
  EXPECT_LT(disk_p_value([](Point2 u) {
              return Point2{u.x * std::cos(2 * pi * u.y), u.x * std::sin(2 * pi * u.y)};
            }),
            1e-6);
}

TEST(UniformDisk, RoundTrip) {
  EXPECT_LT(test::round_trip_error(20000, 1, uniform_disk, uniform_disk_inverse), 1e-12);
  EXPECT_DOUBLE_EQ(uniform_disk_inverse({0.0, 0.0}).x, 0.5);
}

TEST(CosineHemisphere, MatchesItsDensity) {
  EXPECT_GT(test::direction_test({0, 0, 1}, 0.0, 200000, 2, cosine_hemisphere, cosine_hemisphere_density),
            1e-4);
  EXPECT_LT(test::round_trip_error(20000, 3, cosine_hemisphere, cosine_hemisphere_inverse), 1e-9);
}

TEST(CosineHemisphere, UniformDensityIsCaught) {
  EXPECT_LT(test::direction_test({0, 0, 1}, 0.0, 200000, 2, cosine_hemisphere,
                                 [](Vec3) { return 1.0 / (2.0 * pi); }),
            1e-6);
}

TEST(TangentFrame, IsOrthonormalAndRightHanded) {
  for (int k = 0; k < 1000; ++k) {
    const Vec3 n = tilted(pi * unit_double(hash(9, k, 0)), 2 * pi * unit_double(hash(9, k, 1)));
    const TangentFrame frame(n);
    EXPECT_NEAR(math::length(math::cross(frame.first, frame.second) - n), 0.0, 1e-14);
    EXPECT_NEAR(math::dot(frame.first, frame.second), 0.0, 1e-14);
    EXPECT_NEAR(math::length(frame.to_world(frame.to_local({1, 2, 3})) - Vec3{1, 2, 3}), 0.0, 1e-14);
  }
}

TEST(UniformCone, MatchesItsDensity) {
  for (double half_angle : {kSunHalfAngle, 30.0 * kDegree, 100.0 * kDegree}) {
    const UniformCone cone(half_angle);
    const Vec3 axis = tilted(1.1, 0.4);
    EXPECT_GT(test::direction_test(
                  axis, std::cos(half_angle), 100000, 4, [&](Point2 u) { return cone.sample(axis, u); },
                  [&](Vec3 w) { return cone.density(axis, w); }),
              1e-4)
        << half_angle;
    EXPECT_LT(test::round_trip_error(
                  20000, 5, [&](Point2 u) { return cone.sample(axis, u); },
                  [&](Vec3 w) { return cone.inverse(axis, w); }),
              1e-9)
        << half_angle;
  }
}

double solar_p_value(double half_angle, double zenith, bool planted_fault) {
  const SolarDisc disc(half_angle);
  const UniformCone cone(half_angle);
  const Vec3 normal = tilted(0.3, 2.0);
  const TangentFrame frame(normal);
  const Vec3 axis = frame.to_world(tilted(zenith, 0.7));
  return test::direction_test(
      axis, std::cos(half_angle), 400000, 6,
      [&](Point2 u) { return planted_fault ? cone.sample(axis, u) : disc.sample(axis, normal, u).direction; },
      [&](Vec3 w) { return disc.density(axis, normal, w); });
}

TEST(SolarDisc, MatchesItsDensity) {
  for (double zenith_deg : {0.0, 40.0, 69.0, 85.0}) {
    EXPECT_GT(solar_p_value(kSunHalfAngle, zenith_deg * kDegree, false), 1e-4) << zenith_deg;
    EXPECT_GT(solar_p_value(20.0 * kDegree, zenith_deg * kDegree, false), 1e-4) << zenith_deg;
  }
}

TEST(SolarDisc, UniformConeIsCaught) {
  EXPECT_LT(solar_p_value(20.0 * kDegree, 60.0 * kDegree, true), 1e-6);
  EXPECT_LT(solar_p_value(kSunHalfAngle, 89.0 * kDegree, true), 1e-6);
}

TEST(SolarDisc, RoundTrip) {
  for (double half_angle : {kSunHalfAngle, 20.0 * kDegree})
    for (double zenith_deg : {0.0, 40.0, 69.0, 89.9}) {
      const SolarDisc disc(half_angle);
      const Vec3 normal{0, 0, 1}, axis = tilted(zenith_deg * kDegree, 0.7);
      EXPECT_LT(test::round_trip_error(
                    5000, 7, [&](Point2 u) { return disc.sample(axis, normal, u).direction; },
                    [&](Vec3 w) { return disc.inverse(axis, normal, w); }),
                1e-7)
          << half_angle << " " << zenith_deg;
    }
}

TEST(SolarDisc, OpenWeightIsTheClosedFormWithoutVariance) {
  const SolarDisc disc(kSunHalfAngle);
  const Vec3 normal{0, 0, 1}, axis = tilted(60.0 * kDegree, 1.0);
  const double closed = pi * std::pow(std::sin(kSunHalfAngle), 2) * 0.5;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const LightSample s = disc.sample(axis, normal, sequence_point(1, i, 0));
    EXPECT_NEAR(s.weight_sr, closed, closed * 1e-12);
    EXPECT_NEAR(math::length(s.direction), 1.0, 1e-12);
    EXPECT_LE(std::acos(std::min(1.0, math::dot(s.direction, axis))), kSunHalfAngle * (1.0 + 1e-6));
  }
}

/// Mean weight against the integral of cos+ over the cap, by fine quadrature about the axis.
double horizon_error_ratio(double half_angle, double zenith, double weight_factor) {
  const SolarDisc disc(half_angle);
  const Vec3 normal{0, 0, 1}, axis = tilted(zenith, 0.2);
  const TangentFrame frame(axis);
  double truth = 0.0;
  constexpr int kFine = 400;
  for (int i = 0; i < kFine; ++i)
    for (int j = 0; j < kFine; ++j) {
      const double depth = disc.solid_angle_sr() / (2 * pi) * (i + 0.5) / kFine,
                   phi = 2 * pi * (j + 0.5) / kFine;
      const double r = std::sqrt(depth * (2.0 - depth));
      truth += std::max(0.0, frame.to_world({r * std::cos(phi), r * std::sin(phi), 1.0 - depth}).z) *
               disc.solid_angle_sr() / (kFine * kFine);
    }
  double mean = 0.0;
  constexpr std::uint32_t kCount = 1u << 14;
  for (std::uint32_t i = 0; i < kCount; ++i)
    mean += weight_factor * disc.sample(axis, normal, sequence_point(3, i, 0)).weight_sr / kCount;
  return truth == 0.0 ? mean : mean / truth - 1.0;
}

TEST(SolarDisc, IrradianceIsRightThroughSunset) {
  for (double half_angle : {kSunHalfAngle, 20.0 * kDegree})
    for (double offset : {-2.0, -1.01, -0.9, 0.0, 0.5, 0.9, 1.01})
      EXPECT_NEAR(horizon_error_ratio(half_angle, pi / 2 + offset * half_angle, 1.0), 0.0, 2e-3)
          << half_angle << " " << offset;
}

TEST(SolarDisc, WrongWeightIsCaught) {
  EXPECT_GT(std::abs(horizon_error_ratio(kSunHalfAngle, pi / 2 - 2.0 * kSunHalfAngle, 1.005)), 2e-3);
}

// An occluder's straight edge across the disc: the weights that pass add up to the disc's visible segment.
TEST(SolarDisc, PenumbraIsTheDiscSegment) {
  const SolarDisc disc(kSunHalfAngle);
  const Vec3 normal{0, 0, 1}, axis = tilted(30.0 * kDegree, 0.0);
  const Vec3 across{0, 1, 0};
  for (double cut : {-0.7, 0.0, 0.4}) {
    double lit = 0.0;
    constexpr std::uint32_t kCount = 1u << 16;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const LightSample s = disc.sample(axis, normal, sequence_point(11, i, 0));
      if (math::dot(s.direction, across) > cut * std::sin(kSunHalfAngle)) lit += s.weight_sr / kCount;
    }
    const double segment = (std::acos(cut) - cut * std::sqrt(1.0 - cut * cut)) / pi;
    EXPECT_NEAR(lit / disc.projected_solid_angle_sr(axis, normal), segment, 1e-3) << cut;
  }
}

}  // namespace
}  // namespace ifov::sampling::test_warp
