#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "radiometry/stokes.h"

namespace ifov::radiometry::test_stokes {
namespace {

constexpr double kPi = std::numbers::pi;

/// Stokes vector of a field E_x(t), E_y(t) at a fixed place, from what can be measured: mean powers behind
/// polarizers along x, y and the diagonals, and the area that the field runs around.
StokesVector measured(std::complex<double> ex, std::complex<double> ey) {
  constexpr int kSteps = 720;
  double x2 = 0.0, y2 = 0.0, up2 = 0.0, down2 = 0.0, area = 0.0;
  const auto at = [&](int step, std::complex<double> e) {
    return (e * std::polar(1.0, -2.0 * kPi * step / kSteps)).real();
  };
  for (int step = 0; step < kSteps; ++step) {
    const double x = at(step, ex), y = at(step, ey);
    // A mean over time of a real field's square is half of its amplitude's.
    x2 += 2.0 * x * x / kSteps;
    y2 += 2.0 * y * y / kSteps;
    up2 += (x + y) * (x + y) / kSteps;
    down2 += (x - y) * (x - y) / kSteps;
    area += 0.5 * (x * at(step + 1, ey) - y * at(step + 1, ex));  // counterclockwise from x to y
  }
  return {x2 + y2, x2 - y2, up2 - down2, 2.0 * area / kPi};
}

TEST(StokesVector, SignsAreThoseOfTheFieldInSpaceAndTime) {
  for (const auto& [ex, ey] : {std::pair<std::complex<double>, std::complex<double>>{1.0, 0.0},
                               {0.3, {0.2, 0.5}},
                               {{0.1, -0.7}, {0.4, 0.4}},
                               {1.0, {0.0, 1.0}}}) {
    const StokesVector s = measured(ex, ey);
    const std::complex<double> both = ex * std::conj(ey);
    EXPECT_NEAR(s.i, std::norm(ex) + std::norm(ey), 1e-9);
    EXPECT_NEAR(s.q, std::norm(ex) - std::norm(ey), 1e-9);
    EXPECT_NEAR(s.u, 2.0 * both.real(), 1e-9);
    EXPECT_NEAR(s.v, -2.0 * both.imag(), 2e-5 * s.i);  // the polygon is a little less than the ellipse
    EXPECT_NEAR(degree_of_polarization(s), 1.0, 2e-5);
  }
  // y a quarter of a period behind x: the field turns from x to y.
  EXPECT_GT(measured(1.0, {0.0, 1.0}).v, 1.9);
}

TEST(StokesVector, DegreesAndAngles) {
  const StokesVector s{2.0, 0.6, -0.8, 0.5};
  EXPECT_DOUBLE_EQ(degree_of_linear_polarization(s), 0.5);
  EXPECT_DOUBLE_EQ(degree_of_circular_polarization(s), 0.25);
  EXPECT_DOUBLE_EQ(degree_of_polarization(s), std::sqrt(0.3125));
  for (const double angle : {0.0, 0.4, 1.5, 3.0})
    EXPECT_NEAR(angle_of_linear_polarization_rad({1.0, std::cos(2.0 * angle), std::sin(2.0 * angle), 0.0}),
                angle, 1e-12);
  EXPECT_EQ(degree_of_linear_polarization({}), 0.0);
  EXPECT_EQ(degree_of_circular_polarization({}), 0.0);
}

}  // namespace
}  // namespace ifov::radiometry::test_stokes
