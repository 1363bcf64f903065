// Errors of the degree and the angle of linear polarization, whatever the correlations of I, Q and U.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "io/quantities/polarization_quantities.h"

namespace ifov::io::quantities::test_polarization_quantities {
namespace {

/// Light of a degree of 0.4 at 22.5 deg, whose I, Q and U err by `spread` times shared and own noise.
constexpr double kI = 10.0, kQ = 4.0 * std::numbers::sqrt2 / 2.0, kU = kQ, kSigma = 0.05;

struct Correlation {
  double i, q, u;  ///< parts of one shared number; the rest is own
};

template <class Error>
double coverage(const Correlation& shared, const Error& error) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 4000;
  int held = 0;
  for (int k = 0; k < kTrials; ++k) {
    const double common = normal(engine);
    const auto off = [&](double part) {
      return kSigma * (part * common + std::sqrt(1.0 - part * part) * normal(engine));
    };
    const StokesEstimate light{
        kI + off(shared.i), kQ + off(shared.q), kU + off(shared.u), kSigma, kSigma, kSigma};
    held += std::abs(light.dolp() - std::hypot(kQ, kU) / kI) <= 1.96 * error(light);
  }
  return static_cast<double>(held) / kTrials;
}

/// Planted fault: no covariance.
double uncorrelated(const StokesEstimate& of) {
  const double linear = std::hypot(of.q, of.u);
  return std::hypot(of.q * of.q_error / linear, of.u * of.u_error / linear, of.dolp() * of.i_error) / of.i;
}

TEST(DegreeOfPolarization, ItsErrorHoldsForAnyCovariance) {
  const auto stated = [](const StokesEstimate& of) { return of.dolp_error(); };
  for (const Correlation& shared : {Correlation{0.0, 0.0, 0.0},
                                    {1.0, 1.0, 1.0},
                                    {-1.0, 1.0, 1.0},
                                    {0.0, 1.0, 1.0},
                                    {0.0, 1.0, -1.0},
                                    {0.7, -0.7, 0.7},
                                    {-0.9, 0.9, 0.5}})
    EXPECT_GE(coverage(shared, stated), 0.94) << shared.i << " " << shared.q << " " << shared.u;
  // It is reached: where Q and U err together and I against them, no smaller error would do.
  EXPECT_LT(coverage({-1.0, 1.0, 1.0}, stated), 0.96);
  EXPECT_LT(coverage({-1.0, 1.0, 1.0}, uncorrelated), 0.85);
  EXPECT_LT(coverage({0.0, 1.0, 1.0}, uncorrelated), 0.90);
}

TEST(AngleOfPolarization, OfUnpolarizedLightIsUnknown) {
  const double any = 180.0 / std::sqrt(12.0);
  EXPECT_DOUBLE_EQ((StokesEstimate{1.0, 0.0, 0.0, 0.0, 0.0, 0.0}).aop_error_deg(), any);
  EXPECT_DOUBLE_EQ((StokesEstimate{1.0, 0.009, 0.0, 0.01, 0.01, 0.01}).aop_error_deg(), any);
  EXPECT_DOUBLE_EQ((StokesEstimate{1.0, 0.0, 0.0102, 0.01, 0.01, 0.01}).aop_error_deg(), any);
  // Strongly polarized light has the error of the first order: s / (2 L).
  EXPECT_NEAR((StokesEstimate{1.0, 0.5, 0.0, 0.0, 0.001, 0.001}).aop_error_deg(),
              0.5 * 0.001 / 0.5 * 180.0 / std::numbers::pi, 1e-6);
}

/// Angles of noise about no and about some light, over the errors that are stated of them.
double held_angles(double degree, bool without_noise) {
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  constexpr int kTrials = 4000;
  int held = 0;
  for (int k = 0; k < kTrials; ++k) {
    const StokesEstimate light{100.0, degree + normal(engine), normal(engine), 0.0, 1.0, 1.0};
    const double off = std::min(light.aop_deg(), 180.0 - light.aop_deg());
    const double linear = std::hypot(light.q, light.u);
    // Planted fault: the error as if the light that noise feigns were there.
    const double first_order =
        std::min(180.0 / std::sqrt(12.0),
                 90.0 / std::numbers::pi * (std::abs(light.u) + std::abs(light.q)) / linear / linear);
    held += off <= 1.96 * (without_noise ? light.aop_error_deg() : first_order);
  }
  return static_cast<double>(held) / kTrials;
}

TEST(AngleOfPolarization, ItsErrorHoldsWhereLittleIsPolarized) {
  for (const double degree : {0.0, 0.5, 1.0, 2.0, 4.0, 20.0})
    EXPECT_GE(held_angles(degree, true), 0.8) << degree;
  EXPECT_LT(held_angles(0.0, false), 0.8);
}

}  // namespace
}  // namespace ifov::io::quantities::test_polarization_quantities
