#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/label_table.h"

namespace ifov::sampling {

/// What a misplaced border costs: the difference of two labels' radiance in units of the standard error that the tolerance allows to a pixel, largest over the steering columns. An area of a px^2
/// put to the wrong label moves the pixel by a * contrast allowed standard errors. A label's own spread counts as well: what is wrong about a sliver is its radiance there, not the mean.
class Contrast {
 public:
  /// `steering` may grow until the first of the limits is set.
  Contrast(const LabelTable& table, const std::vector<int>& steering)
      : table_(table), steering_(steering), none_(table.columns(), 0.0) {}

  /// Makes room for the limits of this many pixels.
  void begin(int pixels) { allowed_.assign(steering_.size() * static_cast<std::size_t>(pixels), INFINITY); }

  /// Standard errors allowed to a pixel of the domain, one per steering column.
  std::span<double> allowed(int pixel) {
    return {allowed_.data() + static_cast<std::size_t>(pixel) * steering_.size(), steering_.size()};
  }
  std::span<const double> allowed(int pixel) const {
    return {allowed_.data() + static_cast<std::size_t>(pixel) * steering_.size(), steering_.size()};
  }

  /// Variance of single points within a label, [label][column].
  std::vector<double>& spread() { return spread_; }
  /// The same of a label whose values, few as they are, are known to differ so: no less than this.
  void widen_spread(std::uint32_t label, std::span<const double> variances) {
    const std::size_t first = label * table_.columns();
    if (spread_.size() < first + variances.size()) spread_.resize(first + variances.size(), 0.0);
    for (std::size_t c = 0; c < variances.size(); ++c)
      spread_[first + c] = std::max(spread_[first + c], variances[c]);
  }

  /// Of two labels' radiance.
  struct Difference {
    const double *mean_a, *mean_b, *variance_a, *variance_b;
    double square(std::size_t column) const {
      const double difference = mean_a[column] - mean_b[column];
      return difference * difference + variance_a[column] + variance_b[column];
    }
  };
  Difference difference(std::uint32_t a, std::uint32_t b) const {
    return {table_.mean(a), table_.mean(b), variance(a), variance(b)};
  }

  double operator()(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const {
    const double* allowed_here = &allowed_[pixel * steering_.size()];
    const Difference between = difference(a, b);
    double worst = 0.0;
    for (std::size_t d = 0; d < steering_.size(); ++d)
      worst = std::max(worst, between.square(static_cast<std::size_t>(steering_[d])) /
                                  (allowed_here[d] * allowed_here[d]));
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
  const double* variance(std::uint32_t label) const {
    const std::size_t i = label * table_.columns();
    return i < spread_.size() ? &spread_[i] : none_.data();
  }

  const LabelTable& table_;
  const std::vector<int>& steering_;
  std::vector<double> none_;  // what labels found later than the lattice have, but where they are uneven
  std::vector<double> allowed_, spread_;
};

}  // namespace ifov::sampling
