#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sampling/quantiles.h"

namespace ifov::sampling {

/// Quantiles for intervals that are looked at more than once. The chance of error alpha is spent over the
/// looks (least on the first two: the lattice alone, a pilot), so that
/// whichever look stops, the interval holds; by Bonferroni.
class Stopping {
 public:
  static constexpr int kLooks = 8;

  explicit Stopping(double confidence) : confidence_(confidence), normal_(two_sided_normal(confidence)) {}

  /// Of the part of the error that no look can bias.
  double normal() const { return normal_; }

  /// Of the part that was estimated at this look (from 0) with these degrees of freedom.
  double student(int look, double degrees_of_freedom) const {
    const int freedom = static_cast<int>(std::clamp(degrees_of_freedom, 1.0, 200.0));
    if (cache_.empty()) cache_.assign(kLooks * 201, 0.0);
    double& quantile = cache_[std::clamp(look, 0, kLooks - 1) * 201 + freedom];
    if (quantile == 0.0)
      quantile =
          two_sided_student(1.0 - (1.0 - confidence_) * kShare[std::clamp(look, 0, kLooks - 1)], freedom);
    return quantile;
  }

 private:
  static constexpr double kShare[kLooks] = {0.02, 0.06, 0.22, 0.25, 0.2, 0.13, 0.08, 0.04};
  double confidence_, normal_;
  mutable std::vector<double> cache_;
};

/// Degrees of freedom of a sum of estimated variances (Satterthwaite 1946).
class Satterthwaite {
 public:
  void add(double variance, double degrees_of_freedom) {
    sum_ += variance;
    if (degrees_of_freedom > 0.0) weighted_ += variance * variance / degrees_of_freedom;
  }
  double variance() const { return sum_; }
  double degrees_of_freedom() const { return weighted_ > 0.0 ? sum_ * sum_ / weighted_ : 1e9; }

 private:
  double sum_ = 0.0, weighted_ = 0.0;
};

}  // namespace ifov::sampling
