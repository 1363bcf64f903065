#pragma once

#include <span>
#include <vector>

namespace ifov::sensor {

/// What an element still has of the light of exposures before (docs/theory/detectors.md): a share that stays behind when it is read, and
/// what it has not come to yet as it follows with a time constant.
class SignalMemory {
 public:
  SignalMemory() = default;
  /// Shares of what was there before, below 1: what stays behind, and exp(-period / time constant).
  SignalMemory(double lag, double inertia);

  bool none() const { return weights_.size() <= 1; }

  /// Of this exposure, the one before, and so on; their sum is 1. The last stands for all that were earlier, together below 1e-7 where
  /// light is steady.
  std::span<const double> weights() const { return weights_; }

  /// Of a signal that swings by so many cycles an exposure.
  double modulation(double cycles) const;

 private:
  double lag_ = 0.0, inertia_ = 0.0;
  std::vector<double> weights_{1.0};
};

/// Along the samples of a line, from the first or from the last on, that an element takes one after the other; before the first it has
/// seen what it sees then.
void remember_along(const SignalMemory& memory, bool backwards, std::span<float> samples);

}  // namespace ifov::sensor
