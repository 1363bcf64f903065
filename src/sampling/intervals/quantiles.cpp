#include "sampling/intervals/quantiles.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace ifov::sampling {

double two_sided_normal(double confidence) {
  // Abramowitz and Stegun 26.2.23 (error 4.5e-4), then Halley's method on the exact tail.
  const double tail = 1.0 - confidence;
  const double t = std::sqrt(-2.0 * std::log(0.5 * tail));
  double x =
      t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
  for (int step = 0; step < 3; ++step) {
    const double density = std::sqrt(2.0 / std::numbers::pi) * std::exp(-0.5 * x * x);
    const double move = (std::erfc(x / std::numbers::sqrt2) - tail) / density;
    x += move / (1.0 - 0.5 * x * move);
  }
  return x;
}

namespace {

/// Regularised incomplete beta function, Lentz's continued fraction (Press et al., Numerical Recipes, 6.4).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0 || x >= 1.0) return x <= 0.0 ? 0.0 : 1.0;
  if (x > (a + 1.0) / (a + b + 2.0)) return 1.0 - incomplete_beta(b, a, 1.0 - x);
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) /
      a;
  double c = 1.0, d = 1.0 / (1.0 - (a + b) * x / (a + 1.0)), h = d;
  for (int m = 1; m < 1000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1.0 / (1.0 + even * d);
    c = 1.0 + even / c;
    h *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 / (1.0 + odd * d);
    c = 1.0 + odd / c;
    h *= c * d;
    if (std::abs(c * d - 1.0) < 1e-16) break;
  }
  return front * h;
}

double sought_student(double confidence, double degrees_of_freedom) {
  const double nu = degrees_of_freedom;
  const auto outside = [nu](double x) { return incomplete_beta(0.5 * nu, 0.5, nu / (nu + x * x)); };
  double low = two_sided_normal(confidence), high = 2.0 * low;
  while (outside(high) > 1.0 - confidence) high *= 2.0;
  while (high - low > 1e-13 * high) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (outside(middle) > 1.0 - confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double two_sided_student(double confidence, double degrees_of_freedom) {
  // Each tile asks for the same some hundred, which take some fifty continued fractions to seek.
  struct Known {
    double confidence = 0.0, degrees_of_freedom = 0.0, quantile = 0.0;
  };
  static thread_local std::array<Known, 2048> known;
  const std::hash<double> hash;
  Known& one = known[(hash(confidence) * 0x9e3779b97f4a7c15u + hash(degrees_of_freedom)) % known.size()];
  if (one.confidence != confidence || one.degrees_of_freedom != degrees_of_freedom)
    one = {confidence, degrees_of_freedom, sought_student(confidence, degrees_of_freedom)};
  return one.quantile;
}

}  // namespace ifov::sampling
