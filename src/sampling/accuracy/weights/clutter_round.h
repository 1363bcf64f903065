#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sampling/accuracy/weights/block_sums.h"
#include "sampling/accuracy/weights/grid_sides.h"
#include "sampling/random.h"

namespace ifov::sampling {

class PixelFootprint;
struct PathRequest;

/// Values of a cluttered pixel at the points of one jittered grid, one to a cell, in blocks of 2 x 2 cells. The error of
/// their mean falls as n^(-3/4) where borders make it, and what a plane through a block's four values does not explain
/// shows its variance. Where all points beside a border happen to lie on one side of it the blocks see nothing: the
/// variance is never less than what neighbours of unlike values tell of borders between them.
/// docs/theory/accuracy_sampler.md, section 8.
class ClutterRound {
 public:
  /// `keep`: every value is kept, for footprints that weigh them unlike.
  ClutterRound(GridSides sides, std::size_t stride, bool keep);

  GridSides sides() const { return sides_; }
  std::size_t count() const { return static_cast<std::size_t>(sides_.columns) * sides_.rows; }
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
  double spread(int column) const {
    return sums_.spread(column);
  }  ///< variance of the values, wherever they stand
  const BlockSums& sums() const { return sums_; }
  /// Weights of the values as the footprint about `centre` has them.
  std::vector<double> weigh(const PixelFootprint& footprint, Point2 centre) const;
  /// Of values that weigh so; of values that weigh alike where none lies under the footprint.
  Moment moment(int column, std::span<const double> weights) const;

  /// Writes what is known of the values, of each row the first `columns`, to an archive, or reads it from there into a
  /// round of the same sides.
  template <class Round, class Archive>
  static void pass(Round& self, Archive& archive, std::size_t columns) {
    BlockSums::pass(self.sums_, archive, columns);
    std::uint64_t materials = self.materials_.size();
    archive(materials);
    if constexpr (Archive::kReads) self.materials_.resize(std::min<std::uint64_t>(materials, self.count()));
    for (auto& [material, values] : self.materials_) {
      archive(material);
      archive(values);
    }
    archive.list(self.steps_);
    if (!self.keep_) return;
    archive.list(self.points_);
    if constexpr (Archive::kReads) self.values_.assign(self.points_.size() * self.stride_, 0.0f);
    for (std::size_t k = 0; k < self.points_.size(); ++k)
      archive.array(&self.values_[k * self.stride_], columns);
  }

  /// Values on each material.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& materials() const { return materials_; }

 private:
  friend class ClutterGrid;
  static constexpr double kPerPair = 1.0 / 8.0;
  /// Of the value of a cell, in the order in which they come.
  std::size_t place(int i, int j) const {
    return static_cast<std::size_t>(((j / 2) * (sides_.columns / 2) + i / 2) * static_cast<int>(kBlock) +
                                    j % 2 * 2 + i % 2);
  }
  void add_neighbours(std::size_t block, const float* const (&rows)[kBlock]);

  GridSides sides_;
  std::size_t stride_;
  bool keep_;
  BlockSums sums_;
  std::size_t blocks_in_ = 0;  // that have come
  std::vector<double> steps_;  // by column: sum of the squared differences of neighbouring cells
  // Values of the cells above the row of blocks that comes in, and of those left of the block.
  std::vector<float> above_;
  std::vector<float> values_;
  std::vector<Point2> points_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> materials_;
};

}  // namespace ifov::sampling
