#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "sampling/projected_polygon.h"

namespace ifov::test_projected_polygon {
namespace {

using math::Vec3;
using sampling::ProjectedPolygon;

/// A level element below one corner of a level rectangle a x b at height h, sr.
double corner_sr(double a, double b, double h) {
  const double x = a / h, y = b / h;
  return 0.5 * (x / std::sqrt(1.0 + x * x) * std::atan(y / std::sqrt(1.0 + x * x)) +
                y / std::sqrt(1.0 + y * y) * std::atan(x / std::sqrt(1.0 + y * y)));
}

TEST(ProjectedPolygon, LevelRectangleHasItsViewFactor) {
  for (const double a : {0.01, 1.0, 30.0})
    for (const double b : {0.2, 5.0}) {
      const std::array<Vec3, 4> corners{Vec3{0, 0, 2}, {a, 0, 2}, {a, b, 2}, {0, b, 2}};
      EXPECT_NEAR(ProjectedPolygon(corners, {0, 0, 1}).projected_solid_angle_sr(), corner_sr(a, b, 2.0),
                  1e-12 * corner_sr(a, b, 2.0));
    }
}

TEST(ProjectedPolygon, WallIsCutByTheHorizon) {
  // An upright wall seen from a level element: the half below the ground does not count.
  const double half = 1.5, height = 2.0, away = 0.7;
  const std::array<Vec3, 4> wall{
      Vec3{away, -half, -3}, {away, half, -3}, {away, half, height}, {away, -half, height}};
  const double reach = std::hypot(away, height);
  const double expected = std::atan(half / away) - away / reach * std::atan(half / reach);
  EXPECT_NEAR(ProjectedPolygon(wall, {0, 0, 1}).projected_solid_angle_sr(), expected, 1e-12);
}

TEST(ProjectedPolygon, NothingAboveTheHorizonIsNothing) {
  const std::array<Vec3, 3> below{Vec3{1, 0, -1}, {0, 1, -1}, {1, 1, -0.5}};
  EXPECT_EQ(ProjectedPolygon(below, {0, 0, 1}).projected_solid_angle_sr(), 0.0);
}

/// The largest misfit of moments of the projected directions, in standard errors, against points thrown over the polygon's
/// plane and weighted by what they subtend; infinite where a direction misses the polygon. `bend` spoils the samples.
double worst_moment(const std::vector<Vec3>& corners, Vec3 normal, double bend, std::mt19937& random) {
  const ProjectedPolygon seen(corners, normal);
  const Vec3 a = corners[0], x = corners[1] - a, y = corners.back() - a, n = math::cross(x, y);
  const bool triangle = corners.size() == 3;
  std::uniform_real_distribution<> u;
  std::array<double, 3> sum{}, wanted{}, square{};
  constexpr int kGrid = 64;
  int missed = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const Vec3 w =
        seen.sample({std::pow((i % kGrid + u(random)) / kGrid, 1.0 + bend), (i / kGrid + u(random)) / kGrid});
    const Vec3 in = w * (math::dot(a, n) / math::dot(w, n)) - a;
    const double s = math::dot(math::cross(in, y), n) / math::dot(n, n);
    const double t = math::dot(math::cross(x, in), n) / math::dot(n, n);
    missed += s < -1e-6 || t < -1e-6 || (triangle ? s + t > 1 + 1e-6 : s > 1 + 1e-6 || t > 1 + 1e-6) ||
              math::dot(w, normal) < -1e-9;
    const std::array<double, 3> moment{s, t, s * t};
    for (int k = 0; k < 3; ++k)
      sum[k] += moment[k] / (kGrid * kGrid), square[k] += moment[k] * moment[k] / (kGrid * kGrid);
  }
  if (missed > 0) return INFINITY;
  double whole = 0.0;
  constexpr int kFine = 400;
  for (int i = 0; i < kFine * kFine; ++i) {
    const double s = (i % kFine + 0.5) / kFine, t = (i / kFine + 0.5) / kFine;
    if (triangle && s + t > 1.0) continue;
    const Vec3 p = a + x * s + y * t;
    const double d2 = math::dot(p, p), cosine = math::dot(p, normal);
    const double weight = std::max(0.0, cosine) * std::abs(math::dot(p, n)) / (d2 * d2);
    whole += weight;
    wanted[0] += weight * s, wanted[1] += weight * t, wanted[2] += weight * s * t;
  }
  double worst = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double spread = std::sqrt(std::max(1e-12, square[k] - sum[k] * sum[k]) / (kGrid * kGrid));
    worst = std::max(worst, std::abs(sum[k] - wanted[k] / whole) / (spread + 1e-3));
  }
  return worst;
}

double worst_of_many(double bend) {
  std::mt19937 random(7);
  std::normal_distribution<> gauss;
  const auto any = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
  double worst = 0.0;
  int tried = 0;
  while (tried < 60) {
    const Vec3 normal = math::normalized(any()), a = any(), x = any(), y = any();
    const std::vector<Vec3> corners =
        tried % 2 == 0 ? std::vector<Vec3>{a, a + x, a + y} : std::vector<Vec3>{a, a + x, a + x + y, a + y};
    if (ProjectedPolygon(corners, normal).projected_solid_angle_sr() < 0.05) continue;
    worst = std::max(worst, worst_moment(corners, normal, bend, random));
    ++tried;
  }
  return worst;
}

TEST(ProjectedPolygon, DirectionsAreUniformInProjectedSolidAngle) { EXPECT_LT(worst_of_many(0.0), 3.0); }

TEST(ProjectedPolygon, PlantedFaultBentAzimuthsFail) { EXPECT_GT(worst_of_many(0.2), 3.0); }

}  // namespace
}  // namespace ifov::test_projected_polygon
