#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include "radiometry/mueller.h"

namespace ifov::test {

/// Eigenvalues of the coherency matrix sum M_ij sigma_i (x) conj(sigma_j) / 4 of a Mueller matrix, rising. A
/// matrix is a mixture of changes of fields, and so can be, where none is negative (Cloude 1986; Givens and
/// Kostinski 1993, J. Mod. Opt. 40, 471).
inline std::array<double, 4> coherency_eigenvalues(const radiometry::MuellerMatrix& m) {
  using Complex = std::complex<double>;
  constexpr Complex i{0.0, 1.0};
  const std::array<std::array<Complex, 4>, 4> sigma{
      {{1.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, -1.0}, {0.0, 1.0, 1.0, 0.0}, {0.0, -i, i, 0.0}}};
  // A Hermitian matrix A + iB has twice over the eigenvalues of the symmetric [A -B; B A].
  double s[8][8] = {};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      Complex sum = 0.0;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
          sum += 0.25 * m(a, b) * sigma[a][2 * (row / 2) + column / 2] *
                 std::conj(sigma[b][2 * (row % 2) + column % 2]);
      s[row][column] = s[row + 4][column + 4] = sum.real();
      s[row + 4][column] = sum.imag();
      s[row][column + 4] = -sum.imag();
    }
  for (int sweep = 0; sweep < 30; ++sweep)  // Jacobi's rotations
    for (std::size_t p = 0; p < 8; ++p)
      for (std::size_t q = p + 1; q < 8; ++q) {
        if (std::abs(s[p][q]) < 1e-300) continue;
        const double half = 0.5 * std::atan2(2.0 * s[p][q], s[q][q] - s[p][p]);
        const double c = std::cos(half), t = std::sin(half);
        for (std::size_t k = 0; k < 8; ++k) {
          const double x = s[k][p], y = s[k][q];
          s[k][p] = c * x - t * y;
          s[k][q] = t * x + c * y;
        }
        for (std::size_t k = 0; k < 8; ++k) {
          const double x = s[p][k], y = s[q][k];
          s[p][k] = c * x - t * y;
          s[q][k] = t * x + c * y;
        }
      }
  std::array<double, 8> all;
  for (std::size_t k = 0; k < 8; ++k) all[k] = s[k][k];
  std::sort(all.begin(), all.end());
  return {all[0], all[2], all[4], all[6]};
}

}  // namespace ifov::test
