#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sampling/accuracy/stopping.h"

namespace ifov::sampling {

/// Sums over source pixels for the output pixels of a tile, per asked column.
class OutputSums {
 public:
  /// Those of one output, one element per column.
  struct Row {
    double *mean, *geometry;
    Satterthwaite* path;
    double* deviation;  ///< sum of weight * standard deviation of one value, for Neyman's allocation

    bool paths_vary(std::size_t columns) const {
      return std::any_of(path, path + columns, [](const Satterthwaite& p) { return p.variance() > 0.0; });
    }
  };

  explicit OutputSums(std::size_t outputs) : outputs_(outputs) {}

  /// Zero for these outputs; what is known of others is lost where the number of columns changes.
  void clear(std::span<const int> outputs, std::size_t columns) {
    columns_ = columns;
    if (mean_.size() < outputs_ * columns) {
      mean_.resize(outputs_ * columns);
      geometry_.resize(outputs_ * columns);
      path_.resize(outputs_ * columns);
      deviation_.resize(outputs_ * columns);
    }
    for (const int output : outputs) {
      const Row row = (*this)[output];
      for (std::size_t c = 0; c < columns; ++c) {
        row.mean[c] = row.geometry[c] = row.deviation[c] = 0.0;
        row.path[c] = {};
      }
    }
  }

  Row operator[](int output) {
    const std::size_t first = static_cast<std::size_t>(output) * columns_;
    return {&mean_[first], &geometry_[first], &path_[first], &deviation_[first]};
  }
  std::span<const double> means(int output) const {
    return {&mean_[static_cast<std::size_t>(output) * columns_], columns_};
  }

 private:
  std::size_t outputs_, columns_ = 0;
  std::vector<double> mean_, geometry_, deviation_;  // [output][column]
  std::vector<Satterthwaite> path_;
};

}  // namespace ifov::sampling
