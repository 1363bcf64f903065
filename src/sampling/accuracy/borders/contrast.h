#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/label_table.h"

namespace ifov::sampling {

/// What a misplaced border costs: the difference of two labels' radiance in units of the standard error that
/// the tolerance allows to a pixel, largest over the steering channels. An area of a px^2 put to the wrong label
/// moves the pixel by a * contrast allowed standard errors. A label's own spread counts as well: what is
/// wrong about a sliver is its radiance there, not the mean.
class Contrast {
 public:
  Contrast(const LabelTable& table, std::span<const int> steering_channels, int pixels)
      : table_(table),
        steering_channels_(steering_channels),
        allowed_(steering_channels.size() * static_cast<std::size_t>(pixels), INFINITY) {}

  /// Standard errors allowed to a pixel of the domain, one per driver.
  std::span<double> allowed(int pixel) {
    return {allowed_.data() + static_cast<std::size_t>(pixel) * steering_channels_.size(),
            steering_channels_.size()};
  }
  std::span<const double> allowed(int pixel) const {
    return {allowed_.data() + static_cast<std::size_t>(pixel) * steering_channels_.size(),
            steering_channels_.size()};
  }

  /// Variance of single points within a label, one per driver; label-major.
  std::vector<double>& spread() { return spread_; }

  double operator()(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const {
    const double* allowed_here = &allowed_[pixel * steering_channels_.size()];
    const double* mean_a = table_.mean(a);
    const double* mean_b = table_.mean(b);
    double worst = 0.0;
    for (std::size_t d = 0; d < steering_channels_.size(); ++d) {
      const double difference = mean_a[steering_channels_[d]] - mean_b[steering_channels_[d]];
      const double square = difference * difference + variance(a, d) + variance(b, d);
      worst = std::max(worst, square / (allowed_here[d] * allowed_here[d]));
    }
    return std::sqrt(worst);
  }

  /// Largest contrast among the labels of a cell's corners.
  double among(std::uint32_t pixel, const std::uint32_t corner[4]) const {
    std::uint32_t distinct[4];
    int count = 0;
    double worst = 0.0;
    for (int i = 0; i < 4; ++i) {
      if (std::find(distinct, distinct + count, corner[i]) != distinct + count) continue;
      for (int j = 0; j < count; ++j) worst = std::max(worst, (*this)(pixel, distinct[j], corner[i]));
      distinct[count++] = corner[i];
    }
    return worst;
  }

 private:
  double variance(std::uint32_t label, std::size_t driver) const {
    const std::size_t i = label * steering_channels_.size() + driver;
    return i < spread_.size() ? spread_[i] : 0.0;
  }

  const LabelTable& table_;
  std::span<const int> steering_channels_;
  std::vector<double> allowed_, spread_;
};

}  // namespace ifov::sampling
