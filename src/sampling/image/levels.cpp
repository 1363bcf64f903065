#include "sampling/image/levels.h"

#include <algorithm>
#include <cmath>

#include "sampling/pixel_footprint.h"

namespace ifov::sampling {

template <class Sum>
LevelAccumulatorIn<Sum>::LevelAccumulatorIn(std::size_t length) : length_(length) {
  for (std::vector<Sum>* row : {&direct_, &contrast_, &contrast_squares_, &first_, &rest_, &rest_squares_})
    row->resize(length);
  clear();
}

template <class Sum>
void LevelAccumulatorIn<Sum>::clear() {
  direct_count_ = rest_count_ = 0;
  for (std::vector<Sum>* row : {&direct_, &contrast_squares_, &rest_, &rest_squares_})
    std::fill(row->begin(), row->end(), Sum{0});
}

template <class Sum>
void LevelAccumulatorIn<Sum>::add_direct(const float* row) {
  Sum* __restrict sum = direct_.data();
  Sum* __restrict contrast = contrast_.data();
  Sum* __restrict squares = contrast_squares_.data();
  const float* __restrict x = row;
  switch (direct_count_++ % 4) {
    case 0:
      for (std::size_t i = 0; i < length_; ++i) sum[i] += x[i], contrast[i] = x[i];
      return;
    case 1:
    case 2:
      for (std::size_t i = 0; i < length_; ++i) sum[i] += x[i], contrast[i] -= x[i];
      return;
    default:
      for (std::size_t i = 0; i < length_; ++i) {
        sum[i] += x[i];
        const Sum whole = contrast[i] + x[i];
        squares[i] += whole * whole;
      }
  }
}

template <class Sum>
void LevelAccumulatorIn<Sum>::add_rest(const float* row) {
  if (rest_count_++ == 0) {
    std::copy(row, row + length_, first_.begin());
    return;
  }
  Sum* __restrict sum = rest_.data();
  Sum* __restrict squares = rest_squares_.data();
  const float* __restrict x = row;
  const Sum* __restrict first = first_.data();
  for (std::size_t i = 0; i < length_; ++i) {
    const Sum d = x[i] - first[i];
    sum[i] += d;
    squares[i] += d * d;
  }
}

template <class Sum>
void LevelAccumulatorIn<Sum>::take(float* direct, float* direct_variance, float* rest,
                                   float* rest_variance) const {
  const Sum n = static_cast<Sum>(std::max(direct_count_, 1u)), m = static_cast<Sum>(rest_count_);
  for (std::size_t i = 0; i < length_; ++i) {
    direct[i] = static_cast<float>(direct_[i] / n);
    direct_variance[i] =
        static_cast<float>(contrast_squares_[i] / n);  // squares are four times the variance, of n / 4 fours
    rest[i] = static_cast<float>(rest_count_ > 0 ? first_[i] + rest_[i] / m : Sum{0});
    rest_variance[i] = static_cast<float>(
        rest_count_ > 1 ? std::max(Sum{0}, (rest_squares_[i] - rest_[i] * rest_[i] / m) / (m - Sum{1}))
                        : Sum{0});
  }
}

template class LevelAccumulatorIn<float>;
template class LevelAccumulatorIn<double>;

namespace {

/// Of values(), all of it direct.
template <class Sum>
void add_up(const LevelRequests& of, const std::vector<float>& values, std::size_t columns,
            std::size_t stride, LevelSums& sums) {
  LevelAccumulatorIn<Sum> group(columns);
  std::size_t k = 0;
  for (std::size_t g = 0; g < of.counts.size(); ++g) {
    group.clear();
    for (std::uint32_t n = 0; n < of.counts[g]; ++n) group.add_direct(values.data() + k++ * stride);
    const std::size_t row = g * stride;
    group.take(sums.direct.data() + row, sums.direct_variance.data() + row, sums.rest.data() + row,
               sums.rest_variance.data() + row);
  }
}

/// Makes of values v that count w the values m + w (v - m) / W, with m = sum(w v) / sum(w) over the group and W the mean of w: their
/// mean is m, and they differ by what the ratio's error comes from (Cochran, Sampling Techniques, 3rd ed. 1977, 6.3).
void weigh(const LevelRequests& of, std::size_t columns, std::size_t stride, std::vector<float>& values,
           LevelSums& sums) {
  const std::size_t groups = of.footprints->groups();
  std::size_t first = 0;
  for (const std::uint32_t count : of.counts) {
    std::vector<double> all(groups, 0.0), squares(groups, 0.0);
    for (std::size_t k = first; k < first + count; ++k)
      for (std::size_t g = 0; g < groups; ++g) {
        const double w = of.importance[k * groups + g];
        all[g] += w;
        squares[g] += w * w;
      }
    const auto weight = [&](std::size_t k, std::size_t g) {
      // Where no point lies under a footprint, all of them stand for it.
      return all[g] > 0.0 ? static_cast<double>(of.importance[k * groups + g]) * count / all[g] : 1.0;
    };
    // Values differ less from a mean of their own than from the true one, by as many as count for them.
    const auto wider = [&](std::size_t g) {
      constexpr double kFewest = 0.1;
      const double own = all[g] > 0.0 ? squares[g] / (all[g] * all[g]) : 1.0;
      return 1.0 / std::sqrt(std::max(kFewest, 1.0 - own));
    };
    for (std::size_t k = first; k < first + count; ++k)
      sums.label_weights[k] = static_cast<float>(weight(k, 0));
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t g = of.footprints->group_of(c);
      double mean = 0.0;
      for (std::size_t k = first; k < first + count; ++k)
        mean += weight(k, g) * static_cast<double>(values[k * stride + c]) / count;
      for (std::size_t k = first; k < first + count; ++k) {
        float& value = values[k * stride + c];
        value = static_cast<float>(mean + wider(g) * weight(k, g) * (static_cast<double>(value) - mean));
      }
    }
    first += count;
  }
}

}  // namespace

void Field::levels(const LevelRequests& of, LevelSums& sums) {
  const auto stride = static_cast<std::size_t>(this->stride());
  std::vector<float> values(of.requests.size() * stride);
  sums.labels.resize(of.requests.size());
  this->values(of.requests, sums.labels, values);
  sums.label_weights.clear();
  if (!of.importance.empty()) {
    sums.label_weights.resize(of.requests.size());
    weigh(of, static_cast<std::size_t>(columns()), stride, values, sums);
  }
  for (std::vector<float>* rows : {&sums.direct, &sums.direct_variance, &sums.rest, &sums.rest_variance})
    rows->assign(of.counts.size() * stride, 0.0f);
  // Columns that add up to others do so to the last digits only where no sum of many values rounds them off.
  bool parts = false;
  for (int c = 0; c < columns(); ++c) parts = parts || leader(c) != c;
  (parts ? add_up<double> : add_up<float>)(of, values, static_cast<std::size_t>(columns()), stride, sums);
}

}  // namespace ifov::sampling
