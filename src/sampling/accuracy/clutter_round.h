#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sampling/accuracy/block_sums.h"
#include "sampling/field.h"
#include "sampling/pixel_footprint.h"
#include "sampling/sequence.h"

namespace ifov::sampling {

/// Values of a cluttered pixel at the points of one jittered grid, one to a cell, in blocks of 2 x 2 cells. The error of
/// their mean falls as n^(-3/4) where borders make it, and what a plane through a block's four values does not explain
/// shows its variance. Where all points beside a border happen to lie on one side of it the blocks see nothing: the
/// variance is never less than what neighbours on unlike materials tell of borders between them.
/// docs/theory/accuracy_sampler.md, section 8.
class ClutterRound {
 public:
  /// A grid of side x side cells, side even. `keep`: every value is kept, for footprints that weigh them unlike.
  ClutterRound(int side, std::size_t stride, bool keep);

  int side() const { return side_; }
  std::size_t count() const { return static_cast<std::size_t>(side_) * side_; }
  static constexpr std::size_t kBlock = 4;

  std::uint32_t blocks() const { return static_cast<std::uint32_t>(count() / kBlock); }
  /// The paths of a round: elements of a sequence from `first` on.
  struct Paths {
    std::uint64_t sequence;
    std::uint32_t first;
  };
  /// Requests for the values of a block of the pixel at (px, py), at points drawn by `key`, appended.
  void request(int px, int py, std::uint64_t key, const Paths& paths, std::uint32_t block,
               std::vector<PathRequest>& requests) const;

  /// The four values of the next block, row by row, rows of stride floats, and the materials they stand on.
  void add_block(const float* values, std::span<const std::uint32_t, kBlock> materials,
                 std::span<const PathRequest, kBlock> requests);

  struct Moment {
    double mean = 0.0;
    double variance = 0.0;  ///< of the mean
    double freedom = 0.0;   ///< degrees of freedom behind the variance
  };
  Moment moment(int column) const;
  double spread(int column) const { return sums_.spread(column); }  ///< variance of the values, wherever they stand
  /// Two materials (by their place in materials()) that neighbouring cells show, and the sum over such neighbours of the
  /// products of their weights, where all weights add up to 1.
  struct Border {
    std::uint32_t a, b;
    double weight;
  };
  struct Weights {
    std::vector<double> values;
    std::vector<Border> borders;
  };
  /// Weights of the values as the footprint about `centre` has them.
  void weigh(const PixelFootprint& footprint, Point2 centre, Weights& weights) const;
  /// Of values that weigh so; of values that weigh alike where none lies under the footprint.
  Moment moment(int column, const Weights& weights) const;

  /// Writes what is known of the values, of each row the first `columns`, to an archive, or reads it from there into a
  /// round of the same side.
  template <class Round, class Archive>
  static void pass(Round& self, Archive& archive, std::size_t columns) {
    BlockSums::pass(self.sums_, archive, columns);
    std::uint64_t materials = self.materials_.size();
    archive(materials);
    if constexpr (Archive::kReads) self.materials_.resize(std::min<std::uint64_t>(materials, self.count()));
    if constexpr (Archive::kReads) self.of_material_.assign(self.materials_.size() * self.stride_, 0.0);
    for (std::size_t m = 0; m < self.materials_.size(); ++m) {
      archive(self.materials_[m].first);
      archive(self.materials_[m].second);
      archive.array(&self.of_material_[m * self.stride_], columns);
    }
    archive.list(self.cells_);
    if constexpr (Archive::kReads) self.find_borders({}, self.borders_);
    if (!self.keep_) return;
    archive.list(self.points_);
    if constexpr (Archive::kReads) self.values_.assign(self.points_.size() * self.stride_, 0.0f);
    for (std::size_t k = 0; k < self.points_.size(); ++k) archive.array(&self.values_[k * self.stride_], columns);
  }

  /// Values on each material.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& materials() const { return materials_; }

 private:
  /// Of weights of the values (empty: all alike).
  void find_borders(std::span<const double> weights, std::vector<Border>& borders) const;
  double border_variance(int column, std::span<const Border> borders) const;

  int side_;
  std::size_t stride_;
  bool keep_;
  BlockSums sums_;
  std::vector<float> values_;
  std::vector<Point2> points_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> materials_;
  std::vector<double> of_material_;   // [material][column]: sums of its values
  std::vector<std::uint32_t> cells_;  // in the order of the values: place in materials_
  std::vector<Border> borders_;       // of values that weigh alike
};

}  // namespace ifov::sampling
