#include "sensor/detector/memory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::sensor {

SignalMemory::SignalMemory(double lag, double inertia) : lag_(lag), inertia_(inertia) {
  constexpr double kLeft = 1e-7;
  weights_.clear();
  // One after the other: the second forgets what the first gives it.
  double first = 1.0 - lag, both = (1.0 - lag) * (1.0 - inertia), left = 1.0;
  while (left - both > kLeft) {
    weights_.push_back(both);
    left -= both;
    first *= lag;
    both = inertia * both + (1.0 - inertia) * first;
  }
  weights_.push_back(left);
}

double SignalMemory::modulation(double cycles) const {
  const auto of = [&](double share) {
    return (1.0 - share) /
           std::sqrt(1.0 - 2.0 * share * std::cos(2.0 * std::numbers::pi * cycles) + share * share);
  };
  return of(lag_) * of(inertia_);
}

void remember_along(const SignalMemory& memory, bool backwards, std::span<float> samples) {
  const std::span<const double> weights = memory.weights();
  if (backwards) std::reverse(samples.begin(), samples.end());
  for (std::size_t x = samples.size(); x-- > 0;) {
    double sum = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k)
      sum += weights[k] * static_cast<double>(samples[x > k ? x - k : 0]);
    samples[x] = static_cast<float>(sum);
  }
  if (backwards) std::reverse(samples.begin(), samples.end());
}

}  // namespace ifov::sensor
