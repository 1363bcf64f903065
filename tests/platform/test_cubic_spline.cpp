#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "platform/cubic_spline.h"

namespace ifov::platform::test_cubic_spline {
namespace {

double at(const CubicSpline& spline, double t) {
  double value = 0.0;
  spline.at(t, {&value, 1});
  return value;
}

TEST(CubicSpline, IsTheCubicThatItsPointsLieOn) {
  const std::vector<double> knots{-1.0, 0.2, 0.9, 2.5, 3.0, 4.7};
  const auto cubic = [](double t) { return 2.0 - t + 0.7 * t * t - 0.3 * t * t * t; };
  std::vector<double> values;
  for (const double t : knots) values.push_back(cubic(t)), values.push_back(3.0 * t);
  const CubicSpline spline(knots, values);
  ASSERT_EQ(spline.components(), 2u);
  for (double t = -1.0; t < 4.7; t += 0.0937) {
    std::array<double, 2> value{}, slope{};
    spline.at(t, value, slope);
    EXPECT_NEAR(value[0], cubic(t), 1e-12);
    EXPECT_NEAR(slope[0], -1.0 + 1.4 * t - 0.9 * t * t, 1e-12);
    EXPECT_NEAR(value[1], 3.0 * t, 1e-12);
    EXPECT_NEAR(slope[1], 3.0, 1e-12);
  }
}

TEST(CubicSpline, OfFewPointsIsAParabolaALineOrConstant) {
  const CubicSpline parabola({0.0, 1.0, 3.0}, {1.0, 2.0, 10.0});  // 1 + t^2 at 0, 1 and 3
  EXPECT_NEAR(at(parabola, 2.0), 5.0, 1e-14);
  EXPECT_NEAR(at(parabola, 0.5), 1.25, 1e-14);
  const CubicSpline line({0.0, 4.0}, {1.0, 3.0}), constant({2.0}, {7.0});
  EXPECT_NEAR(at(line, 3.0), 2.5, 1e-15);
  EXPECT_EQ(at(constant, -5.0), 7.0);
  EXPECT_EQ(at(constant, 5.0), 7.0);
}

TEST(CubicSpline, GoesOnStraightBeyondItsEnds) {
  const CubicSpline spline({0.0, 1.0, 2.0, 3.0, 4.0}, {0.0, 1.0, 4.0, 9.0, 16.0});
  std::array<double, 1> value{}, slope{};
  spline.at(6.0, value, slope);
  EXPECT_NEAR(value[0], 16.0 + 2.0 * 8.0, 1e-12);
  EXPECT_NEAR(slope[0], 8.0, 1e-12);
  spline.at(-3.0, value, slope);
  EXPECT_NEAR(value[0], 0.0, 1e-12);
}

/// Twenty points a turn: the error of a cubic through a sine, 5/384 h^4 within (Hall and Meyer 1976) and some times that at the ends.
TEST(CubicSpline, FollowsASine) {
  constexpr double kStep = 2.0 * 3.14159265358979323846 / 20.0;
  std::vector<double> knots, values;
  for (int k = 0; k <= 40; ++k) knots.push_back(k * kStep), values.push_back(std::sin(k * kStep));
  const CubicSpline spline(knots, values);
  const double bound = 5.0 / 384.0 * std::pow(kStep, 4);
  for (double t = 3.0 * kStep; t < 37.0 * kStep; t += 0.01)
    EXPECT_NEAR(at(spline, t), std::sin(t), 1.05 * bound);
  for (double t = 0.0; t < 40.0 * kStep; t += 0.01) EXPECT_NEAR(at(spline, t), std::sin(t), 10.0 * bound);
}

}  // namespace
}  // namespace ifov::platform::test_cubic_spline
