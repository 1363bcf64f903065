#include "math/chi_square.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ifov::math {

double upper_gamma(double a, double x) {
  if (x <= 0.0) return 1.0;
  const double scale = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 2000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
    return 1.0 - sum * scale;
  }
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
  for (int n = 1; n < 2000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return h * scale;
}

double chi_square_p_value(double statistic, double degrees_of_freedom) {
  return upper_gamma(0.5 * degrees_of_freedom, 0.5 * statistic);
}

double chi_square_test(const std::vector<double>& observed, const std::vector<double>& expected) {
  std::vector<std::size_t> order(expected.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  double statistic = 0.0, pooled_observed = 0.0, pooled_expected = 0.0;
  int cells = 0;
  for (std::size_t i : order) {
    if (expected[i] == 0.0 && observed[i] > 0.0) return 0.0;
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected < 5.0) continue;
    const double difference = pooled_observed - pooled_expected;
    statistic += difference * difference / pooled_expected;
    pooled_observed = pooled_expected = 0.0;
    ++cells;
  }
  return cells < 2 ? 1.0 : chi_square_p_value(statistic, cells - 1);
}

}  // namespace ifov::math
