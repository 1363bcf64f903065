#pragma once

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
  void add_block(std::span<const float* const> rows);

  double count() const { return count_; }    ///< values
  double blocks() const { return blocks_; }  ///< of two values and more: degrees of freedom at most
  double mean(int column) const { return count_ > 0.0 ? sums_[column] / count_ : 0.0; }
  /// Variance of the values about their mean, wherever they stand.
  double spread(int column) const;
  /// Sum over the blocks of their estimates of the variance of a value.
  double squares(int column) const { return count_ > 0.0 ? sums_[2 * stride_ + column] : 0.0; }

  /// Square of how far rare values are from the others, as the blocks tell: 4 E[s^2]/E[s] of squares s with mean E[s], less the
  /// 12 E[s] that normal values would give; 0 where none is rare.
  double rare(int column) const;

  /// Values that stand in no block, and the sum of what each tells of the variance of a value.
  double alone() const { return alone_; }
  double squares_alone(int column) const { return count_ > 0.0 ? sums_[4 * stride_ + column] : 0.0; }

  /// Degrees of freedom behind the squares. Where a few blocks hold most of the variance, few are: a square with one
  /// degree of freedom has a third of its own square's expectation as its squared expectation.
  double freedom(int column) const;

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
  void add_alone(const float* row);

  static constexpr std::size_t kSums = 5;
  std::size_t stride_;
  double count_ = 0.0, blocks_ = 0.0, alone_ = 0.0;
  /// Of values, of their squares, of the blocks' squares, of the squares of those, of the squares of values alone.
  std::vector<double> sums_;
  std::vector<float> last_alone_;
};

}  // namespace ifov::sampling
