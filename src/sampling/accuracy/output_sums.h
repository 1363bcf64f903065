#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/stopping.h"

namespace ifov::sampling {

/// Sums over source pixels for the output pixels of a tile, per asked column.
class OutputSums {
 public:
  /// Those of one output, one element per column.
  struct Row {
    double *mean, *geometry;
    Satterthwaite* path;  ///< as if all paths were drawn apart
    /// As replicates of paths differ, else as `path`; null where nothing has replicates.
    Satterthwaite* replicated;
    /// Sum of weight * standard deviation of one value, for Neyman's allocation; with what values have not met, as if n values left 1 / n of it as well.
    double *deviation, *deviation_unmet;
    double* gain;      ///< variance of paths over what it would be if all were drawn apart
    double* foretold;  ///< the part of `path` that more values leave as it is: of means taken from maps
    double* unmet;  ///< the part of `path` that falls with the square of their number: what they have not met

    void add_path(std::size_t column, double variance, double freedom) const {
      path[column].add(variance, freedom);
      if (replicated != nullptr) replicated[column].add(variance, freedom);
    }
    /// What sequences gain, as this output's own replicates tell; where it has none, of no freedom.
    SequenceGain own_gain(std::size_t column) const {
      const double apart = path[column].variance();
      if (replicated == nullptr || !(apart > 0.0)) return {1.0, 0.0};
      return {replicated[column].variance() / apart, std::max(0.0, replicated[column].degrees_of_freedom())};
    }
    /// About how many values paths drawn apart would leave the variance of `path` by.
    double values(std::size_t column) const {
      const double apart = path[column].variance();
      return apart > 0.0 ? deviation[column] * deviation[column] / apart : 0.0;
    }
    /// Leaves in `path` the smaller of what paths drawn apart and what sequences leave. Both are too large rather than too small: the one does not know what sequences gain, the other what fine
    /// grids do.
    void settle_path(std::size_t column, SequenceGain known) const {
      // Few degrees of freedom widen an interval about as a variance larger by 4 / nu would.
      constexpr double kFewest = 4.0, kWidening = 4.0;
      if (known.freedom < kFewest || known.value * (1.0 + kWidening / known.freedom) >= 1.0) return;
      path[column] = Satterthwaite(known.value * path[column].variance(), known.freedom);
      gain[column] = known.value;
    }

    bool paths_vary(std::size_t columns) const {
      return std::any_of(path, path + columns, [](const Satterthwaite& p) { return p.variance() > 0.0; });
    }
  };

  OutputSums(std::size_t outputs, bool replicates) : outputs_(outputs), replicates_(replicates) {}

  /// Zero for these outputs; what is known of others is lost where the number of columns changes.
  void clear(std::span<const int> outputs, std::size_t columns) {
    columns_ = columns;
    if (mean_.size() < outputs_ * columns) {
      mean_.resize(outputs_ * columns);
      geometry_.resize(outputs_ * columns);
      path_.resize(outputs_ * columns);
      if (replicates_) replicated_.resize(outputs_ * columns);
      deviation_.resize(outputs_ * columns);
      deviation_unmet_.resize(outputs_ * columns);
      unmet_.resize(outputs_ * columns);
      gain_.resize(outputs_ * columns);
      foretold_.resize(outputs_ * columns);
    }
    for (const int output : outputs) {
      const Row row = (*this)[output];
      for (std::size_t c = 0; c < columns; ++c) {
        row.mean[c] = row.geometry[c] = row.foretold[c] = row.unmet[c] = 0.0;
        row.deviation[c] = row.deviation_unmet[c] = 0.0;
        row.path[c] = {};
        if (replicates_) row.replicated[c] = {};
        row.gain[c] = 1.0;
      }
    }
  }

  Row operator[](int output) {
    const std::size_t first = static_cast<std::size_t>(output) * columns_;
    return {&mean_[first],      &geometry_[first],
            &path_[first],      replicates_ ? &replicated_[first] : nullptr,
            &deviation_[first], &deviation_unmet_[first],
            &gain_[first],      &foretold_[first],
            &unmet_[first]};
  }
  std::span<const double> means(int output) const {
    return {&mean_[static_cast<std::size_t>(output) * columns_], columns_};
  }

 private:
  std::size_t outputs_, columns_ = 0;
  bool replicates_;
  std::vector<double> mean_, geometry_, deviation_, deviation_unmet_, gain_, foretold_,
      unmet_;  // [output][column]
  std::vector<Satterthwaite> path_, replicated_;
};

}  // namespace ifov::sampling
