#include "sampling/image/levels.h"

#include <algorithm>

namespace ifov::sampling {

LevelAccumulator::LevelAccumulator(std::size_t length) : length_(length) {
  for (std::vector<float>* row : {&direct_, &contrast_, &contrast_squares_, &first_, &rest_, &rest_squares_})
    row->resize(length);
  clear();
}

void LevelAccumulator::clear() {
  direct_count_ = rest_count_ = 0;
  for (std::vector<float>* row : {&direct_, &contrast_squares_, &rest_, &rest_squares_})
    std::fill(row->begin(), row->end(), 0.0f);
}

void LevelAccumulator::add_direct(const float* row) {
  float* __restrict sum = direct_.data();
  float* __restrict contrast = contrast_.data();
  float* __restrict squares = contrast_squares_.data();
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
        const float whole = contrast[i] + x[i];
        squares[i] += whole * whole;
      }
  }
}

void LevelAccumulator::add_rest(const float* row) {
  if (rest_count_++ == 0) {
    std::copy(row, row + length_, first_.begin());
    return;
  }
  float* __restrict sum = rest_.data();
  float* __restrict squares = rest_squares_.data();
  const float* __restrict x = row;
  const float* __restrict first = first_.data();
  for (std::size_t i = 0; i < length_; ++i) {
    const float d = x[i] - first[i];
    sum[i] += d;
    squares[i] += d * d;
  }
}

void LevelAccumulator::take(float* direct, float* direct_variance, float* rest, float* rest_variance) const {
  const float n = static_cast<float>(std::max(direct_count_, 1u)), m = static_cast<float>(rest_count_);
  for (std::size_t i = 0; i < length_; ++i) {
    direct[i] = direct_[i] / n;
    direct_variance[i] = contrast_squares_[i] / n;  // squares are four times the variance, of n / 4 fours
    rest[i] = rest_count_ > 0 ? first_[i] + rest_[i] / m : 0.0f;
    rest_variance[i] =
        rest_count_ > 1 ? std::max(0.0f, (rest_squares_[i] - rest_[i] * rest_[i] / m) / (m - 1.0f)) : 0.0f;
  }
}

void Field::levels(const LevelRequests& of, LevelSums& sums) {
  const auto stride = static_cast<std::size_t>(this->stride());
  std::vector<float> values(of.requests.size() * stride);
  sums.labels.resize(of.requests.size());
  this->values(of.requests, sums.labels, values);
  for (std::vector<float>* rows : {&sums.direct, &sums.direct_variance, &sums.rest, &sums.rest_variance})
    rows->assign(of.counts.size() * stride, 0.0f);
  LevelAccumulator group(static_cast<std::size_t>(columns()));
  std::size_t k = 0;
  for (std::size_t g = 0; g < of.counts.size(); ++g) {
    group.clear();
    for (std::uint32_t n = 0; n < of.counts[g]; ++n) group.add_direct(values.data() + k++ * stride);
    const std::size_t row = g * stride;
    group.take(sums.direct.data() + row, sums.direct_variance.data() + row, sums.rest.data() + row,
               sums.rest_variance.data() + row);
  }
}

}  // namespace ifov::sampling
