#include "sampling/accuracy/weights/block_sums.h"

#include <algorithm>

namespace ifov::sampling {

void BlockSums::add_block(std::span<const float* const> rows) {
  if (sums_.empty()) sums_.resize(kSums * stride_, 0.0);
  if (rows.size() == 1) add_alone(rows[0]);
  count_ += static_cast<double>(rows.size());
  double *sum = sums_.data(), *power = sum + stride_, *squares = power + stride_,
         *fourths = squares + stride_;
  if (rows.size() == 4) {
    const float *a = rows[0], *b = rows[1], *d = rows[2], *e = rows[3];
    for (std::size_t c = 0; c < stride_; ++c) {
      const double v[4] = {a[c], b[c], d[c], e[c]};
      sum[c] += (v[0] + v[1]) + (v[2] + v[3]);
      power[c] += (v[0] * v[0] + v[1] * v[1]) + (v[2] * v[2] + v[3] * v[3]);
      const double twist = (v[0] - v[1]) - (v[2] - v[3]), square = 0.25 * twist * twist;
      squares[c] += square;
      fourths[c] += square * square;
    }
    blocks_ += 1.0;
    return;
  }
  for (const float* row : rows)
    for (std::size_t c = 0; c < stride_; ++c) {
      const double value = row[c];
      sum[c] += value;
      power[c] += value * value;
    }
  if (rows.size() < 2) return;
  for (std::size_t c = 0; c < stride_; ++c) {
    const double difference = static_cast<double>(rows[0][c]) - rows[1][c],
                 square = 0.5 * difference * difference;
    squares[c] += square;
    fourths[c] += square * square;
  }
  blocks_ += 1.0;
  if (rows.size() < 3) return;
  double* alone = fourths + stride_;
  for (std::size_t c = 0; c < stride_; ++c) {
    const double difference = static_cast<double>(rows[2][c]) - rows[1][c];
    alone[c] += 0.5 * difference * difference;
  }
  alone_ += 1.0;
}

double BlockSums::spread(int column) const {
  if (count_ == 0.0) return 0.0;
  const double m = mean(column);
  return std::max(0.0, sums_[stride_ + column] / count_ - m * m);
}

double BlockSums::rare(int column) const {
  const double square = squares(column);
  if (!(square > 0.0)) return 0.0;
  return std::max(0.0, 4.0 * sums_[3 * stride_ + column] / square - 12.0 * square / blocks_);
}

double BlockSums::freedom(int column) const {
  const double fourth = count_ > 0.0 ? sums_[3 * stride_ + column] : 0.0, square = squares(column);
  return fourth > 0.0 ? std::min(blocks_, 3.0 * square * square / fourth) : blocks_;
}

void BlockSums::add_alone(const float* row) {
  double* alone = &sums_[4 * stride_];
  const bool any = !last_alone_.empty();
  for (std::size_t c = 0; c < stride_ && count_ > 0.0; ++c) {
    const double value = row[c], before = value - sums_[c] / count_;
    double square = before * before * count_ / (count_ + 1.0);
    if (any) square = std::min(square, 0.5 * (value - last_alone_[c]) * (value - last_alone_[c]));
    alone[c] += square;
  }
  if (count_ > 0.0) alone_ += 1.0;
  last_alone_.assign(row, row + stride_);
}

}  // namespace ifov::sampling
