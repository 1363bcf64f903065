#include "materials/curve_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "sampling/random.h"

namespace ifov::materials {

namespace {

constexpr std::size_t kMostRanges = 16;
/// Scores that differ by less are equal, and so are squared distances that differ by its square: rounding.
constexpr double kSame = 1e-6;
constexpr double kTie = kSame * kSame;
/// A range adds nothing where so little of its variance is its own.
constexpr double kLeastOwnVariance = 1e-9;

/// Keeps one of equally good candidates: the k-th is taken with a probability of 1 / k.
class Choice {
 public:
  explicit Choice(std::uint64_t key) : key_(key) {}
  void offer(std::uint32_t candidate) {
    ++seen_;
    if (sampling::unit_double(sampling::hash(key_, seen_)) * static_cast<double>(seen_) < 1.0)
      chosen_ = candidate;
  }
  void restart() { seen_ = 0; }
  std::uint32_t chosen() const { return chosen_; }

 private:
  std::uint64_t key_, seen_ = 0;
  std::uint32_t chosen_ = 0;
};

}  // namespace

CurveMatcher::CurveMatcher(std::vector<double> means, std::size_t ranges, Distance distance)
    : count_(ranges == 0 ? 0 : means.size() / ranges), ranges_(ranges), scores_(std::move(means)) {
  if (ranges_ < 1 || ranges_ > kMostRanges || scores_.size() != count_ * ranges_)
    throw InputError(format("curves are matched in 1 to {} spectral ranges: found {}", kMostRanges, ranges_));
  if (count_ < 2)
    throw InputError(format("a texture needs at least 2 curves to choose from: found {}", count_));
  for (std::size_t j = 0; j < ranges_; ++j) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t c = 0; c < count_; ++c) sum += scores_[c * ranges_ + j];
    const double mean = sum / static_cast<double>(count_);
    for (std::size_t c = 0; c < count_; ++c) squares += std::pow(scores_[c * ranges_ + j] - mean, 2.0);
    const double deviation = std::sqrt(squares / static_cast<double>(count_));
    if (!(deviation > 1e-12 * std::max(1e-6, std::abs(mean))))
      throw InputError(format("all curves have the same mean, {:g}, in spectral range {}", mean, j + 1));
    for (std::size_t c = 0; c < count_; ++c)
      scores_[c * ranges_ + j] = (scores_[c * ranges_ + j] - mean) / deviation;
    mean_.push_back(mean);
    deviation_.push_back(deviation);
  }
  points_ = scores_;
  if (distance == Distance::covariance) {
    decorrelate();
    for (std::size_t c = 0; c < count_; ++c) whiten({points_.data() + c * ranges_, ranges_});
  }
  sorted_.resize(count_);
  std::iota(sorted_.begin(), sorted_.end(), 0u);
  if (ranges_ == 1)
    std::stable_sort(sorted_.begin(), sorted_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return points_[a] < points_[b]; });
}

void CurveMatcher::decorrelate() {
  // Cholesky: correlations = factor factor^T.
  factor_.assign(ranges_ * ranges_, 0.0);
  for (std::size_t i = 0; i < ranges_; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (std::size_t c = 0; c < count_; ++c) sum += scores_[c * ranges_ + i] * scores_[c * ranges_ + j];
      sum /= static_cast<double>(count_);
      for (std::size_t k = 0; k < j; ++k) sum -= factor_[i * ranges_ + k] * factor_[j * ranges_ + k];
      if (i != j) {
        factor_[i * ranges_ + j] = sum / factor_[j * ranges_ + j];
      } else if (sum > kLeastOwnVariance) {
        factor_[i * ranges_ + i] = std::sqrt(sum);
      } else {
        throw InputError(
            format("the means of the curves in spectral range {} follow from those in the ranges before "
                   "it; leave it out, or match without covariance",
                   i + 1));
      }
    }
}

void CurveMatcher::whiten(std::span<double> scores) const {
  for (std::size_t i = 0; i < ranges_; ++i) {
    for (std::size_t k = 0; k < i; ++k) scores[i] -= factor_[i * ranges_ + k] * scores[k];
    scores[i] /= factor_[i * ranges_ + i];
  }
}

CurveMix CurveMatcher::match(std::span<const double> scores, std::uint64_t key) const {
  if (ranges_ == 1) return match_in_one(scores[0], key);
  std::array<double, kMostRanges> point{};
  std::copy(scores.begin(), scores.end(), point.begin());
  if (!factor_.empty()) whiten({point.data(), ranges_});
  return match_in_many({point.data(), ranges_}, key);
}

CurveMix CurveMatcher::match_in_one(double score, std::uint64_t key) const {
  const auto pick = [&](std::size_t index, std::uint64_t purpose) {
    Choice choice(sampling::hash(key, purpose));
    const double point = points_[sorted_[index]];
    std::size_t first = index;
    while (first > 0 && point - points_[sorted_[first - 1]] < kSame) --first;
    for (std::size_t k = first; k < count_ && points_[sorted_[k]] - point < kSame; ++k)
      choice.offer(sorted_[k]);
    return choice.chosen();
  };
  const auto above = static_cast<std::size_t>(
      std::upper_bound(sorted_.begin(), sorted_.end(), score,
                       [&](double s, std::uint32_t curve) { return s < points_[curve]; }) -
      sorted_.begin());
  if (above == 0 || above == count_) {
    const std::uint32_t outermost = pick(above == 0 ? 0 : count_ - 1, 0);
    return {outermost, outermost, 0.0};
  }
  const std::uint32_t low = pick(above - 1, 0), high = pick(above, 1);
  return {low, high, std::clamp((score - points_[low]) / (points_[high] - points_[low]), 0.0, 1.0)};
}

CurveMix CurveMatcher::match_in_many(std::span<const double> point, std::uint64_t key) const {
  const auto squared = [&](std::size_t curve) {
    double sum = 0.0;
    for (std::size_t j = 0; j < ranges_; ++j) sum += std::pow(points_[curve * ranges_ + j] - point[j], 2.0);
    return sum;
  };
  Choice nearest(sampling::hash(key, 0));
  double best = INFINITY;
  for (std::size_t c = 0; c < count_; ++c) {
    const double distance = squared(c);
    if (distance > best + kTie) continue;
    if (distance < best - kTie) nearest.restart();
    best = std::min(best, distance);
    nearest.offer(static_cast<std::uint32_t>(c));
  }
  const std::size_t a = nearest.chosen();

  Choice partner(sampling::hash(key, 1));
  CurveMix mix{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a), 0.0};
  double best_off = best - kTie, best_length = INFINITY;
  for (std::size_t b = 0; b < count_; ++b) {
    double length = 0.0, along = 0.0;
    for (std::size_t j = 0; j < ranges_; ++j) {
      const double way = points_[b * ranges_ + j] - points_[a * ranges_ + j];
      length += way * way;
      along += way * (point[j] - points_[a * ranges_ + j]);
    }
    if (!(length > kTie) || along <= 0.0) continue;
    const double share = std::min(1.0, along / length);
    const double off = best - 2.0 * share * along + share * share * length;
    const bool same_off = std::abs(off - best_off) <= kTie;
    if (off > best_off + kTie || (same_off && length > best_length + kTie)) continue;
    if (!same_off || length < best_length - kTie) partner.restart();
    best_off = std::min(best_off, off);
    best_length = length;
    partner.offer(static_cast<std::uint32_t>(b));
    if (partner.chosen() == b) mix = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), share};
  }
  return mix;
}

}  // namespace ifov::materials
