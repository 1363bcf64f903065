#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/phase/phase_expansion.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/phase/spherical_functions.h"

namespace test_scattering_phase {
using namespace ifov::atmosphere;

namespace {

using Matrix = std::array<double, 9>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    }
  }
  return c;
}

/// The phase matrix summed over azimuthal modes; `sign` is that of t.
Matrix summed(const PhaseExpansion& e, const Propagation& from, const Propagation& to, double sign) {
  const int terms = static_cast<int>(e.beta.size());
  const double azimuth = to.azimuth_rad - from.azimuth_rad;
  Matrix sum{};
  for (int m = 0; m < terms; ++m) {
    const SphericalFunctions out = spherical_functions(m, terms, to.mu),
                             in = spherical_functions(m, terms, from.mu);
    const double factor = m == 0 ? 1.0 : 2.0, c = factor * std::cos(m * azimuth),
                 s = factor * std::sin(m * azimuth);
    const Matrix turn{c, c, -s, c, c, -s, s, s, c};
    for (int l = m; l < terms; ++l) {
      const int at = l - m;
      const auto functions = [&](const SphericalFunctions& f) {
        return Matrix{f.p[at], 0, 0, 0, f.r[at], sign * f.t[at], 0, sign * f.t[at], f.r[at]};
      };
      const Matrix coefficients{e.beta[l], e.gamma[l], 0, e.gamma[l], e.alpha[l], 0, 0, 0, e.zeta[l]};
      const Matrix mode = product(product(functions(out), coefficients), functions(in));
      for (int i = 0; i < 9; ++i) sum[i] += turn[i] * mode[i];
    }
  }
  return sum;
}

template <class Expected>
double worst_difference(const PhaseExpansion& expansion, const Expected& expected, double sign) {
  double worst = 0.0;
  for (double mu : {-0.95, -0.4, 0.1, 0.8}) {
    for (double mu_in : {-0.6, 0.3, 0.9}) {
      for (double azimuth : {0.3, 1.7, 4.0}) {
        const Propagation from{mu_in, 0.4}, to{mu, azimuth};
        const Matrix a = meridian_matrix(from, to, expected(scattering_cosine(from, to)));
        const Matrix b = summed(expansion, from, to, sign);
        for (int i = 0; i < 9; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
      }
    }
  }
  return worst;
}

}  // namespace

TEST(ScatteringPhase, RayleighModesAddUpToTheTurnedMatrix) {
  const auto expected = [](double cosine) { return rayleigh_matrix(cosine, 0.03); };
  EXPECT_LT(worst_difference(rayleigh_expansion(3, 0.03), expected, 1.0), 1e-13);
  EXPECT_GT(worst_difference(rayleigh_expansion(3, 0.03), expected, -1.0), 0.1)
      << "U of the other sign passes";
}

TEST(ScatteringPhase, AerosolModesAddUpToTheTurnedMatrix) {
  const auto expected = [](double cosine) { return aerosol_matrix(cosine, 0.5, 0.3); };
  const AerosolProjection projection(48, 0.3);
  EXPECT_LT(worst_difference(projection.expansion(0.5), expected, 1.0), 1e-10);
  EXPECT_GT(worst_difference(projection.expansion(0.5), expected, -1.0), 0.01);
}

TEST(ScatteringPhase, MeansOverTheSphereAreOne) {
  const GaussNodes nodes = gauss_nodes(96);
  double rayleigh = 0.0, aerosol = 0.0, asymmetry = 0.0;
  for (std::size_t i = 0; i < nodes.position.size(); ++i) {
    const double x = 2.0 * nodes.position[i] - 1.0;
    rayleigh += nodes.weight[i] * rayleigh_matrix(x, 0.0279).a1;
    aerosol += nodes.weight[i] * aerosol_matrix(x, 0.7, 0.1).a1;
    asymmetry += nodes.weight[i] * x * aerosol_matrix(x, 0.7, 0.1).a1;
  }
  EXPECT_NEAR(rayleigh, 1.0, 1e-13);
  EXPECT_NEAR(aerosol, 1.0, 1e-12);
  EXPECT_NEAR(asymmetry, 0.7, 1e-12);
}

TEST(ScatteringPhase, DegreeOfPolarizationOfTheSky) {
  // sin^2 / (1 + cos^2 + 2 d / (1 - d)), across the scattering plane: Q < 0 in it.
  for (double angle : {0.3, 1.0, 1.5707963, 2.4}) {
    const double c = std::cos(angle), d = 0.0279;
    const ScatteringMatrix matrix = rayleigh_matrix(c, d);
    EXPECT_NEAR(-matrix.b1 / matrix.a1, (1.0 - c * c) / (1.0 + c * c + 2.0 * d / (1.0 - d)), 1e-14);
  }
  EXPECT_NEAR(-aerosol_matrix(0.0, 0.6, 0.1).b1 / aerosol_matrix(0.0, 0.6, 0.1).a1, 0.1, 1e-15);
}

TEST(ScatteringPhase, GaussNodesIntegratePolynomials) {
  for (int count : {1, 2, 8, 24, 128}) {
    const GaussNodes nodes = gauss_nodes(count);
    for (int power : {0, 1, 2 * count - 1}) {
      double sum = 0.0;
      for (int i = 0; i < count; ++i) sum += nodes.weight[i] * std::pow(nodes.position[i], power);
      EXPECT_NEAR(sum * (power + 1), 1.0, 1e-12) << count << " nodes, power " << power;
    }
  }
}

TEST(SphericalSeries, IsTheFunctionsOneByOne) {
  for (const int mode : {0, 1, 2, 3, 17})
    for (const bool polarized : {false, true}) {
      const SphericalSeries series(mode, 40, polarized);
      SphericalFunctions found;
      for (const double mu : {-1.0, -0.6, 0.0, 0.01, 0.73, 0.9999, 1.0}) {
        series.at(mu, found);
        const SphericalFunctions one = spherical_functions(mode, 40, mu);
        ASSERT_EQ(found.p.size(), one.p.size());
        for (std::size_t l = 0; l < one.p.size(); ++l) {
          EXPECT_NEAR(found.p[l], one.p[l], 1e-11) << mode << ' ' << mu << ' ' << l;
          if (!polarized) continue;
          EXPECT_NEAR(found.r[l], one.r[l], 1e-11) << mode << ' ' << mu << ' ' << l;
          EXPECT_NEAR(found.t[l], one.t[l], 1e-11) << mode << ' ' << mu << ' ' << l;
        }
      }
    }
}

}  // namespace test_scattering_phase
