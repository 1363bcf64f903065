#include "platform/cubic_spline.h"

#include <algorithm>
#include <utility>

namespace ifov::platform {

CubicSpline::CubicSpline(std::vector<double> knots, std::vector<double> values)
    : components_(values.size() / knots.size()),
      knots_(std::move(knots)),
      values_(std::move(values)),
      bends_(values_.size(), 0.0) {
  const std::size_t n = knots_.size(), count = components_;
  if (n < 3) return;
  const auto step = [&](std::size_t k) { return knots_[k + 1] - knots_[k]; };
  const auto slope = [&](std::size_t k, std::size_t c) {
    return (values_[(k + 1) * count + c] - values_[k * count + c]) / step(k);
  };
  if (n == 3) {
    for (std::size_t c = 0; c < count; ++c)
      bends_[c] = bends_[count + c] = bends_[2 * count + c] =
          2.0 * (slope(1, c) - slope(0, c)) / (step(0) + step(1));
    return;
  }
  // h_{k-1} M_{k-1} + 2 (h_{k-1} + h_k) M_k + h_k M_{k+1} = 6 (s_k - s_{k-1}) for the inner knots; the outermost bends go on
  // evenly from the two beside them.
  std::vector<double> diagonal(n), above(n), right(n * count);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    double below = step(k - 1);
    diagonal[k] = 2.0 * (step(k - 1) + step(k));
    above[k] = step(k);
    if (k == 1) {
      diagonal[k] += step(0) * (1.0 + step(0) / step(1));
      above[k] -= step(0) * step(0) / step(1);
      below = 0.0;
    }
    if (k + 2 == n) {
      diagonal[k] += step(k) * (1.0 + step(k) / step(k - 1));
      below -= step(k) * step(k) / step(k - 1);
      above[k] = 0.0;
    }
    const double share = k == 1 ? 0.0 : below / diagonal[k - 1];
    if (k > 1) diagonal[k] -= share * above[k - 1];
    for (std::size_t c = 0; c < count; ++c)
      right[k * count + c] = 6.0 * (slope(k, c) - slope(k - 1, c)) - share * right[(k - 1) * count + c];
  }
  for (std::size_t k = n - 2; k >= 1; --k)
    for (std::size_t c = 0; c < count; ++c)
      bends_[k * count + c] = (right[k * count + c] - above[k] * bends_[(k + 1) * count + c]) / diagonal[k];
  for (std::size_t c = 0; c < count; ++c) {
    const double* const bend = bends_.data() + c;
    bends_[c] = bend[count] - step(0) / step(1) * (bend[2 * count] - bend[count]);
    bends_[(n - 1) * count + c] =
        bend[(n - 2) * count] + step(n - 2) / step(n - 3) * (bend[(n - 2) * count] - bend[(n - 3) * count]);
  }
}

double CubicSpline::knot_slope(std::size_t knot, std::size_t component) const {
  const std::size_t k = std::min(knot, knots_.size() - 2), at = k * components_ + component;
  const double h = knots_[k + 1] - knots_[k];
  const double straight = (values_[at + components_] - values_[at]) / h;
  return knot == k ? straight - h / 6.0 * (2.0 * bends_[at] + bends_[at + components_])
                   : straight + h / 6.0 * (bends_[at] + 2.0 * bends_[at + components_]);
}

void CubicSpline::at(double t, std::span<double> value, std::span<double> slope) const {
  const std::size_t n = knots_.size();
  if (n == 1 || !(t > knots_.front()) || !(t < knots_.back())) {
    const std::size_t end = t < knots_.back() ? 0 : n - 1;
    for (std::size_t c = 0; c < components_; ++c) {
      const double rise = n == 1 ? 0.0 : knot_slope(end, c);
      value[c] = values_[end * components_ + c] + rise * (t - knots_[end]);
      if (!slope.empty()) slope[c] = rise;
    }
    return;
  }
  const auto next = std::upper_bound(knots_.begin(), knots_.end(), t);
  const std::size_t k = static_cast<std::size_t>(next - knots_.begin()) - 1;
  const double h = knots_[k + 1] - knots_[k], b = (t - knots_[k]) / h, a = 1.0 - b;
  for (std::size_t c = 0; c < components_; ++c) {
    const std::size_t at = k * components_ + c, to = at + components_;
    value[c] = a * values_[at] + b * values_[to] +
               h * h / 6.0 * ((a * a * a - a) * bends_[at] + (b * b * b - b) * bends_[to]);
    if (!slope.empty())
      slope[c] = (values_[to] - values_[at]) / h +
                 h / 6.0 * ((3.0 * b * b - 1.0) * bends_[to] - (3.0 * a * a - 1.0) * bends_[at]);
  }
}

}  // namespace ifov::platform
