#include "sampling/intervals/bounded_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "sampling/intervals/quantiles.h"

namespace ifov::sampling {
namespace {

/// P(|N(t, 1)| > t + x).
double outside(double t, double x) {
  return 0.5 * (std::erfc(x / std::numbers::sqrt2) + std::erfc((2.0 * t + x) / std::numbers::sqrt2));
}

}  // namespace

BoundedError::BoundedError(double confidence) : normal_(two_sided_normal(confidence)) {
  for (std::size_t k = 0; k < beyond_.size(); ++k) {
    const double t = static_cast<double>(k) / kPerUnit;
    double low = -t, high = normal_;  // at low nothing is left out: |N| > 0
    while (high - low > 1e-14 * normal_) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (outside(t, middle) > 1.0 - confidence ? low : high) = middle;
    }
    beyond_[k] = high;
  }
}

// Between the table's points cv(t) - t lies below its chord: it is convex.
double BoundedError::half_width(double random, double bound) const {
  if (!(bound > 0.0) || !(random > 0.0) || !std::isfinite(random) || !std::isfinite(bound))
    return random + bound;
  const double sigma = random / normal_, at = bound / sigma * kPerUnit;
  if (at >= kPerUnit * kLast) return bound + sigma * beyond_.back();
  const auto k = static_cast<std::size_t>(at);
  const double beyond = std::lerp(beyond_[k], beyond_[k + 1], at - static_cast<double>(k));
  return std::min(random + bound, std::max(random, bound + sigma * beyond));
}

double BoundedError::random(double half_width, double bound) const {
  if (!(bound > 0.0) || !std::isfinite(half_width)) return half_width;
  if (!(half_width > bound)) return 0.0;
  // With t = bound / sigma: (half_width / bound - 1) t = cv(t) - t, whose sides rise and fall.
  const double slope = half_width / bound - 1.0;
  std::size_t low = 0, high = beyond_.size() - 1;
  const auto reached = [&](std::size_t k) { return slope * static_cast<double>(k) / kPerUnit >= beyond_[k]; };
  if (!reached(high)) return normal_ * bound * slope / beyond_.back();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (reached(middle) ? high : low) = middle;
  }
  const double fall = (beyond_[low] - beyond_[high]) * kPerUnit,
               t = (beyond_[low] + fall * static_cast<double>(low) / kPerUnit) / (slope + fall);
  return normal_ * bound / t;
}

double BoundedError::bound(double half_width, double random) const {
  double low = 0.0, high = half_width;
  while (high - low > 1e-12 * half_width) {
    const double middle = 0.5 * (low + high);
    (this->half_width(random, middle) > half_width ? high : low) = middle;
  }
  return low;
}

}  // namespace ifov::sampling
