#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "radiometry/coherency.h"
#include "radiometry/fresnel.h"
#include "radiometry/mueller.h"

namespace ifov::radiometry::test_mueller {
namespace {

using test::coherency_eigenvalues;

constexpr double kPi = std::numbers::pi;

double worst_difference(const MuellerMatrix& a, const MuellerMatrix& b) {
  double worst = 0.0;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      worst = std::max(worst, std::abs(a(row, column) - b(row, column)));
  return worst;
}

JonesMatrix diagonal_about(std::complex<double> along, std::complex<double> across, double axis) {
  const double c = std::cos(axis), s = std::sin(axis);
  return {c * c * along + s * s * across, c * s * (along - across), c * s * (along - across),
          s * s * along + c * c * across};
}

std::vector<MuellerMatrix> elements() {
  return {MuellerMatrix(),
          MuellerMatrix::turned_frame(0.7),
          MuellerMatrix::linear_polarizer(0.3),
          MuellerMatrix::linear_diattenuator(0.9, 0.2, 1.1),
          MuellerMatrix::linear_retarder(0.8, 0.4),
          MuellerMatrix::depolarizer(0.4, 0.1),
          MuellerMatrix::depolarizer(0.5, 0.0),
          fresnel_reflection({1.28, 7.3}, 0.3),
          fresnel_reflection(1.5, 0.6),
          fresnel_transmission(1.33, 0.2)};
}

TEST(MuellerMatrix, ElementsAreWhatTheyDoToFields) {
  const double axis = 0.37;
  EXPECT_LT(worst_difference(MuellerMatrix::linear_diattenuator(0.81, 0.16, axis),
                             MuellerMatrix::of_fields(diagonal_about(0.9, 0.4, axis))),
            1e-15);
  EXPECT_LT(worst_difference(MuellerMatrix::linear_polarizer(axis),
                             MuellerMatrix::of_fields(diagonal_about(1.0, 0.0, axis))),
            1e-15);
  // exp(-i omega t): what falls behind by a phase d is multiplied by exp(i d).
  EXPECT_LT(worst_difference(MuellerMatrix::linear_retarder(0.6, axis),
                             MuellerMatrix::of_fields(diagonal_about(std::polar(1.0, 0.6), 1.0, axis))),
            1e-15);
  EXPECT_GT(worst_difference(MuellerMatrix::linear_retarder(0.6, axis),
                             MuellerMatrix::of_fields(diagonal_about(std::polar(1.0, -0.6), 1.0, axis))),
            0.5)
      << "a retarder of the other sign passes";
  // About a turned frame E_x' = cos a E_x + sin a E_y.
  const double c = std::cos(axis), s = std::sin(axis);
  EXPECT_LT(worst_difference(MuellerMatrix::turned_frame(axis), MuellerMatrix::of_fields({c, s, -s, c})),
            1e-15);
  EXPECT_LT(
      worst_difference(MuellerMatrix::turned_frame(5.0 * c, 5.0 * s), MuellerMatrix::turned_frame(axis)),
      1e-15);
}

TEST(MuellerMatrix, LawOfMalusAndQuarterWave) {
  const StokesVector natural{1.0, 0.0, 0.0, 0.0};
  for (const double angle : {0.0, 0.5, 1.2, 2.9}) {
    const StokesVector s =
        MuellerMatrix::linear_polarizer(angle) * (MuellerMatrix::linear_polarizer(0.0) * natural);
    EXPECT_NEAR(s.i, 0.5 * std::pow(std::cos(angle), 2), 1e-15);
    if (s.i > 1e-3) {
      EXPECT_NEAR(angle_of_linear_polarization_rad(s), angle, 1e-12);
    }
  }
  const StokesVector circular = MuellerMatrix::linear_retarder(0.5 * kPi, 0.0) * StokesVector{1, 0, 1, 0};
  EXPECT_NEAR(circular.v, -1.0, 1e-15);
  EXPECT_NEAR(degree_of_linear_polarization(circular), 0.0, 1e-15);
}

TEST(MuellerMatrix, ProductsAreOneAfterTheOther) {
  const MuellerMatrix a = MuellerMatrix::linear_retarder(0.8, 0.4), b = MuellerMatrix::linear_polarizer(0.3);
  const StokesVector s{1.0, 0.2, -0.3, 0.4}, one = (a * b) * s, two = a * (b * s);
  EXPECT_NEAR(one.i, two.i, 1e-15);
  EXPECT_NEAR(one.q, two.q, 1e-15);
  EXPECT_NEAR(one.u, two.u, 1e-15);
  EXPECT_NEAR(one.v, two.v, 1e-15);
  EXPECT_GT(worst_difference(a * b, b * a), 0.05);
  EXPECT_LT(worst_difference((a * b).transposed(), b.transposed() * a.transposed()), 1e-15);
}

// Reciprocity is that of fields: light that comes back meets the transposed Jones matrix, its y turned.
TEST(MuellerMatrix, ReversedIsTheTransposedJonesMatrix) {
  const JonesMatrix j{{0.3, 0.2}, {-0.5, 0.1}, {0.2, 0.7}, {0.1, -0.4}}, back{j.xx, -j.yx, -j.xy, j.yy};
  const MuellerMatrix there = MuellerMatrix::of_fields(j);
  EXPECT_LT(worst_difference(there.reversed(), MuellerMatrix::of_fields(back)), 1e-15);
  EXPECT_GT(worst_difference(there.transposed(), MuellerMatrix::of_fields(back)), 0.05)
      << "the transposed matrix alone passes";
}

TEST(MuellerMatrix, WhatCanBeKeepsLightPossible) {
  for (const MuellerMatrix& m : elements()) {
    EXPECT_GT(coherency_eigenvalues(m)[0], -1e-13);
    for (int k = 0; k < 200; ++k) {
      const double z = -1.0 + 2.0 * (k + 0.5) / 200, a = 2.39996 * k, r = std::sqrt(1.0 - z * z);
      const StokesVector s = m * StokesVector{1.0, r * std::cos(a), r * std::sin(a), z};
      EXPECT_GE(s.i, -1e-14);
      EXPECT_LE(std::hypot(s.q, s.u, s.v), s.i + 1e-13);
    }
  }
  // A change of fields alone has one eigenvalue; a mixture has more.
  EXPECT_NEAR(coherency_eigenvalues(MuellerMatrix::linear_retarder(0.8, 0.4))[2], 0.0, 1e-13);
  EXPECT_NEAR(coherency_eigenvalues(MuellerMatrix::depolarizer(0.4, 0.1))[0], 0.25 * (1.0 - 0.8 + 0.1),
              1e-14);
  // These keep every single beam possible, and yet cannot be: the criterion is the sharper one.
  EXPECT_NEAR(coherency_eigenvalues(MuellerMatrix::diagonal(1.0, 1.0, 1.0, -1.0))[0], -0.5, 1e-14);
  EXPECT_NEAR(coherency_eigenvalues(MuellerMatrix::depolarizer(1.0, 0.0))[0], -0.25, 1e-14);
}

}  // namespace
}  // namespace ifov::radiometry::test_mueller
