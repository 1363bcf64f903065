#pragma once

#include <array>

namespace ifov::sampling {

/// Intervals of estimates that scatter by chance and are off, beside that, by something of unknown sign that is known only to be
/// at most so much: the same in all of them, so that nothing averages out. Such an interval holds the true value with its
/// confidence, whatever that is, where its half-width is sigma cv(bound / sigma), cv(t) the quantile of |N(t, 1)| (Armstrong and
/// Kolesar 2018, Econometrica 86, 655, section 3; docs/theory/atmosphere_error.md). That is less than the sum of both: an
/// estimate that is off to one side by the bound leaves its interval on that side alone.
///
/// What scatters is given by the half-width of its own interval. Where that is wider than a normal distribution's (Student's t),
/// the joined one holds the more.
class BoundedError {
 public:
  /// 0 < confidence < 1.
  explicit BoundedError(double confidence);

  /// Of both. At least the larger of them and at most their sum; that where one is not finite.
  double half_width(double random, double bound) const;
  /// What may scatter so that both make this: the inverse of half_width() in `random`; 0 where the bound alone is as much.
  double random(double half_width, double bound) const;
  /// The same in `bound`, to 1e-12 of the half-width.
  double bound(double half_width, double random) const;

 private:
  static constexpr int kPerUnit = 32, kLast = 5;  // of bound / sigma
  double normal_;
  std::array<double, kPerUnit * kLast + 1> beyond_;  // cv(t) - t; from the last on it is that
};

}  // namespace ifov::sampling
