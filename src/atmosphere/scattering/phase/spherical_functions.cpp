#include "atmosphere/scattering/phase/spherical_functions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ifov::atmosphere {

namespace {

/// d^l_mn at the lowest l that has it.
double lowest(int m, int n, int l, double x) {
  // |m - n| + |m + n| = 2l, so that (2l)! / (|m - n|! |m + n|!) / 4^l is a product of 2l small factors.
  const int a = std::abs(m - n), b = std::abs(m + n);
  double ratio = 1.0;
  for (int i = 1; i <= 2 * l; ++i) ratio *= 0.5 * i / (i <= a ? i : i - a);
  const double sign = n >= m || (m - n) % 2 == 0 ? 1.0 : -1.0;
  return sign * std::sqrt(ratio) * std::pow(std::max(0.0, 1.0 - x), 0.5 * a) *
         std::pow(std::max(0.0, 1.0 + x), 0.5 * b);
}

}  // namespace

std::vector<double> wigner_d(int m, int n, int count, double x) {
  std::vector<double> d(count, 0.0);
  const int first = std::max(std::abs(m), std::abs(n));
  if (first >= count) return d;
  d[first] = lowest(m, n, first, x);
  for (int l = first; l + 1 < count; ++l) {
    if (l == 0) {
      d[1] = x;
      continue;
    }
    const double below = std::sqrt(double((l * l - m * m)) * double(l * l - n * n));
    const int k = l + 1;
    const double above = std::sqrt(double(k * k - m * m) * double(k * k - n * n));
    const double previous = l > first ? d[l - 1] : 0.0;
    d[k] =
        ((2.0 * l + 1.0) * (l * (l + 1.0) * x - m * n) * d[l] - (l + 1.0) * below * previous) / (l * above);
  }
  return d;
}

SphericalFunctions spherical_functions(int mode, int count, double mu) {
  const std::vector<double> plain = wigner_d(mode, 0, count, mu), plus = wigner_d(mode, 2, count, mu),
                            minus = wigner_d(mode, -2, count, mu);
  SphericalFunctions functions;
  for (int l = mode; l < count; ++l) {
    functions.p.push_back(plain[l]);
    functions.r.push_back(0.5 * (plus[l] + minus[l]));
    functions.t.push_back(0.5 * (minus[l] - plus[l]));
  }
  return functions;
}

}  // namespace ifov::atmosphere
