#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/radiance/lattice_values.h"

namespace ifov::sampling {

/// How much single values of one label differ, per column, learnt from the lattice of the tile. Strata with
/// few values of their own borrow it; a label seen seldom borrows in turn from all labels, so that no
/// variance is zero unless every value of every label agrees with its neighbours.
class LabelSpread {
 public:
  /// `table` knows the means over the lattice and nothing else yet.
  LabelSpread(const Lattice& lattice, const LabelTable& table, const LatticeValues& at);

  /// A label that is uneven by nature and that the lattice met seldom or never: its values differ by no less than this.
  void learn(std::uint32_t label, std::span<const double> variances);

  /// Variance of a value about the plane through its neighbours: noise and fine texture. Labels found later
  /// than the lattice have that of all labels, but where more was learnt.
  double local(std::uint32_t label, int column) const { return row(local_, label)[column]; }

  /// Blocks of the lattice that lie in the label: what its own differences are known from.
  double blocks(std::uint32_t label) const { return label < labels_ ? blocks_[label] : 0.0; }

  /// Square of how far the label's rare values are from the others, as their local differences tell: 4 E[s^2]/E[s]
  /// of blocks whose squares s have mean E[s], less the 12 E[s] that normal values would give; 0 where none is rare.
  double rare(std::uint32_t label, int column) const { return row(rare_, label)[column]; }

  /// Whether all values of the label agree, and so do those of all labels that it could borrow a variance from.
  bool constant(std::uint32_t label) const { return label < labels_ && constant_[label] != 0; }

  /// How rests of values differ (LatticeValues::rest); itself where nothing is foretold.
  const LabelSpread& rest() const { return rest_ != nullptr ? *rest_ : *this; }
  const LabelSpread& rest_if(bool foretold) const { return foretold ? rest() : *this; }
  void take_rest(std::unique_ptr<const LabelSpread> rest) { rest_ = std::move(rest); }

  /// Labels that the lattice has met, and the lowest of each one's values.
  std::uint32_t labels() const { return static_cast<std::uint32_t>(labels_); }
  double lowest(std::uint32_t label, int column) const { return lowest_[label * columns_ + column]; }

  /// Variance of a value about the label's mean over the tile.
  double total(std::uint32_t label, int column) const { return row(total_, label)[column]; }

 protected:
  // [label], and [label][column] with a row for all labels together and then those of labels that were learnt of later.
  std::size_t columns_, labels_;
  std::vector<std::uint8_t> constant_;
  std::vector<double> blocks_;
  std::vector<double> local_, total_, rare_;
  std::vector<double> lowest_;

 private:
  void add_random_points(const Lattice& lattice, const LatticeValues& at, std::vector<double>& local_freedom);
  const double* row(const std::vector<double>& table, std::uint32_t label) const {
    return &table[row_of(label) * columns_];
  }
  std::size_t row_of(std::uint32_t label) const {
    if (label < labels_) return label;
    return label - labels_ < late_.size() ? late_[label - labels_] : labels_;
  }

  std::vector<std::size_t> late_;  // rows of labels from labels_ on
  std::unique_ptr<const LabelSpread> rest_;
};

}  // namespace ifov::sampling
