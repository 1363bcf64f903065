#include "sensor/detector/poisson.h"

#include <algorithm>
#include <cmath>

namespace ifov::sensor {

double poisson(double mean, double uniform, double normal) {
  if (!(mean > 0.0)) return 0.0;
  if (mean >= kManyEvents) return std::max(0.0, std::floor(noisy_count(mean, 0.0, normal) + 0.5));
  constexpr int kMost = 400;  // beyond which no number of 52 bits leads
  double probability = std::exp(-mean), below = probability;
  int count = 0;
  while (uniform > below && count < kMost) {
    ++count;
    probability *= mean / count;
    below += probability;
  }
  return count;
}

double noisy_count(double mean, double variance, double normal) {
  const double second = mean + variance, spread = std::sqrt(second);
  const double skewness = mean / (second * spread), kurtosis = mean / (second * second);
  const double square = normal * normal;
  return mean + spread * (normal + skewness * (square - 1.0) / 6.0 +
                          normal * (kurtosis * (square - 3.0) / 24.0 -
                                    skewness * skewness * (2.0 * square - 5.0) / 36.0));
}

}  // namespace ifov::sensor
