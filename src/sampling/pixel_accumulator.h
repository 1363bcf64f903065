#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sampling/field.h"
#include "sampling/pixel_writer.h"

namespace ifov::sampling {

/// Weighted samples of one pixel, gathered by label in running sums, so that their variance splits exactly
/// into what the labels' means differ by (geometry) and what stays inside labels (paths).
class PixelAccumulator {
 public:
  explicit PixelAccumulator(int columns) : columns_(static_cast<std::size_t>(columns)) {}

  void clear();
  void add(double weight, Label label, std::uint32_t material, const float* values);
  int count() const { return count_; }

  /// Mean, and the variance it would have had with points drawn independently with these weights (which add
  /// up to 1): n/(n-1) sum w^2 (x - mean)^2. NaN variances where n < 2. Leaves the quantile to the caller.
  PixelEstimate estimate() const;

 private:
  struct Group {
    Label label;
    std::uint32_t material;
    double weight = 0.0, weight_squared = 0.0;
    // The first sample: sums are of differences from it, so that equal values give 0.
    std::vector<float> origin;
    std::vector<double> w_d, w2_d, w2_d2;  // sums of w d, w^2 d, w^2 d^2 with d = x - origin
  };
  Group& group_of(Label label, std::uint32_t material, const float* values);

  std::size_t columns_;
  std::vector<Group> groups_;
  std::size_t used_ = 0, last_ = 0;
  int count_ = 0;
};

}  // namespace ifov::sampling
