#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace ifov::sampling {

/// Sums over values that stand in blocks of 2 x 2 cells of a jittered grid, per column: what their mean and its variance
/// need, so that the values themselves need not be kept.
class BlockSums {
 public:
  explicit BlockSums(std::size_t stride) : stride_(stride) {}

  /// One block: rows of the values in it, at most four, in the order of its quarters. Of four quarters what a plane does
  /// not explain is one degree of freedom about the variance of a value within its cell, of two or three half the
  /// square of a difference.
  /// A value alone in its block, and the third of three, stand in none of these squares; what they differ by is summed apart.
  void add_block(std::span<const float* const> rows) {
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

  double count() const { return count_; }    ///< values
  double blocks() const { return blocks_; }  ///< of two values and more: degrees of freedom at most
  double mean(int column) const { return count_ > 0.0 ? sums_[column] / count_ : 0.0; }
  /// Variance of the values about their mean, wherever they stand.
  double spread(int column) const {
    if (count_ == 0.0) return 0.0;
    const double m = mean(column);
    return std::max(0.0, sums_[stride_ + column] / count_ - m * m);
  }
  /// Sum over the blocks of their estimates of the variance of a value.
  double squares(int column) const { return count_ > 0.0 ? sums_[2 * stride_ + column] : 0.0; }

  /// Values that stand in no block, and the sum of what each tells of the variance of a value.
  double alone() const { return alone_; }
  double squares_alone(int column) const { return count_ > 0.0 ? sums_[4 * stride_ + column] : 0.0; }

  /// Degrees of freedom behind the squares. Where a few blocks hold most of the variance, few are: a square with one
  /// degree of freedom has a third of its own square's expectation as its squared expectation.
  double freedom(int column) const {
    const double fourth = count_ > 0.0 ? sums_[3 * stride_ + column] : 0.0, square = squares(column);
    return fourth > 0.0 ? std::min(blocks_, 3.0 * square * square / fourth) : blocks_;
  }

  /// Writes the first `columns` of the sums to an archive, or reads them from it.
  template <class Sums, class Archive>
  static void pass(Sums& self, Archive& archive, std::size_t columns) {
    archive(self.count_);
    archive(self.blocks_);
    archive(self.alone_);
    if (self.count_ == 0.0) return;
    if constexpr (Archive::kReads) self.sums_.assign(kSums * self.stride_, 0.0);
    for (std::size_t k = 0; k < kSums; ++k) archive.array(&self.sums_[k * self.stride_], columns);
  }

 private:
  /// By the nearer of the last such value and the mean of all before: a gradient moves it away from either.
  void add_alone(const float* row) {
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

  static constexpr std::size_t kSums = 5;
  std::size_t stride_;
  double count_ = 0.0, blocks_ = 0.0, alone_ = 0.0;
  /// Of values, of their squares, of the blocks' squares, of the squares of those, of the squares of values alone.
  std::vector<double> sums_;
  std::vector<float> last_alone_;
};

}  // namespace ifov::sampling
