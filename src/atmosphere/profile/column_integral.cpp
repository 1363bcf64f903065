#include "atmosphere/profile/column_integral.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace ifov::atmosphere {
namespace {

double interpolated(double a, double b, double f) {
  return a > 0.0 && b > 0.0 ? a * std::pow(b / a, f) : a + (b - a) * f;
}

/// Calls piece(i, f0, f1, length_km) for every interval i of the levels that [first, last] covers from its
/// fraction f0 to f1.
template <class Piece>
void over_pieces(const std::vector<double>& z, double first, double last, Piece piece) {
  assert(std::is_sorted(z.begin(), z.end()));
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const double low = std::max(first, z[i]), high = std::min(last, z[i + 1]);
    if (high <= low) continue;
    const double step = z[i + 1] - z[i];
    piece(i, (low - z[i]) / step, (high - z[i]) / step, high - low);
  }
}

double exponential_mean(double a, double b) {
  if (a > 0.0 && b > 0.0 && std::abs(a / b - 1.0) > 1e-6) return (a - b) / std::log(a / b);
  return 0.5 * (a + b);
}

}  // namespace

double column_integral(const std::vector<double>& altitude_km, const std::vector<double>& density,
                       double first, double last) {
  double sum = 0.0;
  over_pieces(altitude_km, first, last, [&](std::size_t i, double f0, double f1, double length) {
    const double a = interpolated(density[i], density[i + 1], f0);
    const double b = interpolated(density[i], density[i + 1], f1);
    // From or to nothing the density is linear, in every part of the interval.
    const bool exponential = density[i] > 0.0 && density[i + 1] > 0.0;
    sum += length * (exponential ? exponential_mean(a, b) : 0.5 * (a + b));
  });
  return sum;
}

double column_integral(const std::vector<double>& altitude_km, const std::vector<double>& density,
                       const std::vector<double>& temperature_K, double (*factor)(double), double first,
                       double last) {
  constexpr std::array<double, 3> position{0.11270166537925831, 0.5, 0.88729833462074169};
  constexpr std::array<double, 3> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  over_pieces(altitude_km, first, last, [&](std::size_t i, double f0, double f1, double length) {
    for (std::size_t g = 0; g < position.size(); ++g) {
      const double f = f0 + (f1 - f0) * position[g];
      const double temperature = temperature_K[i] + (temperature_K[i + 1] - temperature_K[i]) * f;
      sum += length * weight[g] * interpolated(density[i], density[i + 1], f) * factor(temperature);
    }
  });
  return sum;
}

double density_at(const std::vector<double>& altitude_km, const std::vector<double>& density,
                  double altitude) {
  const auto above = std::upper_bound(altitude_km.begin() + 1, altitude_km.end() - 1, altitude);
  const std::size_t i = static_cast<std::size_t>(above - altitude_km.begin()) - 1;
  return interpolated(density[i], density[i + 1],
                      (altitude - altitude_km[i]) / (altitude_km[i + 1] - altitude_km[i]));
}

}  // namespace ifov::atmosphere
