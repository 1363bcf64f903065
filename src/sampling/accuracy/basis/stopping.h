#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sampling/intervals/quantiles.h"

namespace ifov::sampling {

/// Quantiles for intervals that are tested more than once. A test may end the sampling, and does so the sooner the
/// smaller its estimate of the variance happens to be. Tests of numbers of values that grow by little see almost the same, and of those
/// that grow by much hardly more than two are in doubt: each may spend 0.4 of the probability of error, 0.75 where so many degrees of
/// freedom tell the variance that its estimate hardly chooses the test; the first two (the lattice alone, a pilot) see little and may spend
/// less. That intervals then hold, wherever the sampling ends, is shown by simulation
/// (tests/sampling/test_stopping.cpp).
class Stopping {
 public:
  static constexpr int kTests = 16;

  explicit Stopping(double confidence) : confidence_(confidence), normal_(two_sided_normal(confidence)) {}

  /// Of the part of the error that no test can bias.
  double normal() const { return normal_; }

  /// Of the part that was estimated at this test (from 0) with these degrees of freedom.
  double student(int test, double degrees_of_freedom) const {
    const int freedom = static_cast<int>(std::clamp(degrees_of_freedom, 1.0, 200.0));
    if (cache_.empty()) cache_.assign(3 * 201, 0.0);
    const int row = std::clamp(test, 0, 2);
    double& quantile = cache_[row * 201 + freedom];
    if (quantile == 0.0)
      quantile = two_sided_student(1.0 - (1.0 - confidence_) * share(test, freedom), freedom);
    return quantile;
  }

 private:
  /// Of the probability of error, that a test may spend.
  static double share(int test, double freedom) {
    constexpr double kFew = 16.0, kMany = 100.0;
    if (test < 2) return test < 1 ? 0.05 : 0.1;
    return 0.4 + 0.35 * std::clamp(std::log(freedom / kFew) / std::log(kMany / kFew), 0.0, 1.0);
  }
  double confidence_, normal_;
  mutable std::vector<double> cache_;
};

/// Variance that sequences of paths leave over that of paths drawn apart, and the degrees of freedom that it is known by.
struct SequenceGain {
  double value, freedom;
};

/// Degrees of freedom of a sum of estimated variances (Satterthwaite 1946). An estimate with nu of them has a square of
/// expectation (1 + 2 / nu) sigma^4, which would tell too few of a sum of many: it counts for nu + 2, of which two are
/// taken back from the sum.
class Satterthwaite {
 public:
  Satterthwaite() = default;
  Satterthwaite(double variance, double degrees_of_freedom) { add(variance, degrees_of_freedom); }

  void add(double variance, double degrees_of_freedom) {
    sum_ += variance;
    if (degrees_of_freedom > 0.0) weighted_ += variance * variance / (degrees_of_freedom + 2.0);
  }
  double variance() const { return sum_; }
  double degrees_of_freedom() const { return weighted_ > 0.0 ? sum_ * sum_ / weighted_ - 2.0 : 1e9; }

 private:
  double sum_ = 0.0, weighted_ = 0.0;
};

}  // namespace ifov::sampling
