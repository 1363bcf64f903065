#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/accuracy/flat_map.h"
#include "sampling/field.h"

namespace ifov::sampling {

/// The labels met in a tile, numbered in the order of their discovery, with the mean radiance of each.
class LabelTable {
 public:
  explicit LabelTable(int columns) : columns_(static_cast<std::size_t>(columns)) {}

  std::uint32_t index(Label label) {
    if (!labels_.empty() && labels_[last_] == label) return stands_for_[last_];
    last_ = indices_.find_or_insert(label, static_cast<std::uint32_t>(labels_.size()));
    if (last_ == labels_.size()) {
      labels_.push_back(label);
      stands_for_.push_back(last_);
      counts_.push_back(0);
      means_.resize(means_.size() + columns_, 0.0);
    }
    return stands_for_[last_];
  }

  /// From now on `index` answers `as` for what was numbered `from`.
  void merge(std::uint32_t from, std::uint32_t as) { stands_for_[from] = as; }
  std::uint32_t merged(std::uint32_t index) const { return stands_for_[index]; }

  std::size_t size() const { return labels_.size(); }
  Label label(std::uint32_t index) const { return labels_[index]; }

  /// Takes one value (all columns) of a label into its mean.
  void add(std::uint32_t index, const float* value) {
    const double share = 1.0 / ++counts_[index];
    double* mean = &means_[index * columns_];
    for (std::size_t c = 0; c < columns_; ++c) mean[c] += share * (value[c] - mean[c]);
  }
  std::uint32_t count(std::uint32_t index) const { return counts_[index]; }
  const double* mean(std::uint32_t index) const { return &means_[index * columns_]; }

 private:
  std::size_t columns_;
  FlatMap indices_;
  std::vector<Label> labels_;
  std::vector<std::uint32_t> stands_for_;
  std::vector<std::uint32_t> counts_;
  std::vector<double> means_;
  std::uint32_t last_ = 0;
};

}  // namespace ifov::sampling
