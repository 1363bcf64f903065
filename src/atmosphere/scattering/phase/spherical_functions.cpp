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

SphericalSeries::Recurrence::Recurrence(int m, int n, int count)
    : first(std::max(std::abs(m), std::abs(n))),
      of_minus(0.5 * std::abs(m - n)),
      of_plus(0.5 * std::abs(m + n)) {
  if (first >= count) return;
  lowest = atmosphere::lowest(m, n, first, 0.0);
  for (int l = first; l + 1 < count; ++l) {
    const double k = l + 1.0, of_l = l;
    if (l == 0) {
      a.push_back(1.0), b.push_back(0.0), c.push_back(0.0);
      continue;
    }
    const double below = std::sqrt((of_l * of_l - m * m) * (of_l * of_l - n * n));
    const double above = of_l * std::sqrt((k * k - m * m) * (k * k - n * n));
    a.push_back((2.0 * l + 1.0) * l * k / above);
    b.push_back((2.0 * l + 1.0) * m * n / above);
    c.push_back(l > first ? k * below / above : 0.0);
  }
}

void SphericalSeries::Recurrence::at(double x, std::vector<double>& d) const {
  std::fill(d.begin(), d.end(), 0.0);
  const auto start = static_cast<std::size_t>(first);
  if (start >= d.size()) return;
  const auto power = [](double base, double exponent) {
    return exponent > 0.0 ? std::pow(std::max(0.0, base), exponent) : 1.0;
  };
  d[start] = lowest * power(1.0 - x, of_minus) * power(1.0 + x, of_plus);
  double before = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double now = d[start + k];
    d[start + k + 1] = (a[k] * x - b[k]) * now - c[k] * before;
    before = now;
  }
}

SphericalSeries::SphericalSeries(int mode, int count, bool polarized) : mode_(mode), count_(count) {
  of_.emplace_back(mode, 0, count);
  if (!polarized) return;
  of_.emplace_back(mode, 2, count);
  of_.emplace_back(mode, -2, count);
}

void SphericalSeries::at(double mu, SphericalFunctions& functions) const {
  const auto from = static_cast<std::ptrdiff_t>(mode_);
  const auto size = static_cast<std::size_t>(count_);
  std::vector<double>& d = functions.p;
  d.resize(size);
  of_[0].at(mu, d);
  if (of_.size() > 1) {
    functions.r.resize(size);
    functions.t.resize(size);
    of_[1].at(mu, functions.r);
    of_[2].at(mu, functions.t);
    for (std::size_t l = 0; l < size; ++l) {
      const double plus = functions.r[l], minus = functions.t[l];
      functions.r[l] = 0.5 * (plus + minus);
      functions.t[l] = 0.5 * (minus - plus);
    }
    functions.r.erase(functions.r.begin(), functions.r.begin() + from);
    functions.t.erase(functions.t.begin(), functions.t.begin() + from);
  }
  d.erase(d.begin(), d.begin() + from);
}

}  // namespace ifov::atmosphere
