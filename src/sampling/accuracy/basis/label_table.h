#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/accuracy/basis/flat_map.h"
#include "sampling/field.h"

namespace ifov::sampling {

/// The labels met in a tile, numbered in the order of their discovery, with the mean radiance of each.
class LabelTable {
 public:
  explicit LabelTable(int columns) : LabelTable(columns, columns) {}
  /// `deciding`: the first of the columns, which the others are parts of (Field::leader()).
  LabelTable(int columns, int deciding)
      : columns_(static_cast<std::size_t>(columns)), deciding_(static_cast<std::size_t>(deciding)) {}
  /// As large as the field asks.
  explicit LabelTable(const Field& field);

  std::uint32_t index(Label label) {
    const std::uint32_t known = indices_.find(label);
    return known != FlatMap::kAbsent ? stands_for_[known] : insert(label);
  }

  /// From now on `index` answers `as` for what was numbered `from`.
  void merge(std::uint32_t from, std::uint32_t as) { stands_for_[from] = as; }
  std::uint32_t merged(std::uint32_t index) const { return stands_for_[index]; }

  std::size_t columns() const { return columns_; }
  /// Whether what is said of all columns goes by this one, too; its parts follow it.
  bool decides(int column) const { return static_cast<std::size_t>(column) < deciding_; }
  std::size_t size() const { return labels_.size(); }
  /// Whether there are labels that do not stand for the same.
  bool several() const {
    return std::any_of(stands_for_.begin(), stands_for_.end(),
                       [this](std::uint32_t as) { return as != stands_for_[0]; });
  }
  Label label(std::uint32_t index) const { return labels_[index]; }

  /// Takes one value (all columns) of a label into its mean.
  void add(std::uint32_t index, const float* value) {
    const double share = 1.0 / ++counts_[index];
    double* mean = &means_[index * columns_];
    for (std::size_t c = 0; c < columns_; ++c) mean[c] += share * (value[c] - mean[c]);
  }
  /// The same for more values of a label all of whose values are the same.
  void add_same(std::uint32_t index, const float* value, std::uint32_t times) {
    if (times == 0) return;
    if (counts_[index] == 0) add(index, value), --times;
    counts_[index] += times;
  }
  std::uint32_t count(std::uint32_t index) const { return counts_[index]; }
  const double* mean(std::uint32_t index) const { return &means_[index * columns_]; }

 private:
  std::uint32_t insert(Label label);

  std::size_t columns_, deciding_;
  FlatMap indices_;
  std::vector<Label> labels_;
  std::vector<std::uint32_t> stands_for_;
  std::vector<std::uint32_t> counts_;
  std::vector<double> means_;
};

}  // namespace ifov::sampling
