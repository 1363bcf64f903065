#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/adaptive_sampler.h"
#include "sampling/sub_element_lattice.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

/// The sub-elements of one tile while the adaptive scheme refines them. Those the tile's pixels weigh make
/// the core; one ring around it is refined like the core, so that borders see finished neighbours, and a
/// second ring gets first samples only. All stay within the image (and the footprint's reach beyond it).
class RefinedLattice {
 public:
  RefinedLattice(const SubElementLattice& lattice, const AdaptiveOptions& options,
                 const TileProblem& problem);

  /// Takes first samples everywhere, then, until nothing changes: marks the sub-elements that differ from a
  /// neighbour, and draws one more sample in every marked one that is below its cap.
  void refine(Field& field);

  /// One sub-element, by its numbers in the lattice; it must lie in the core.
  std::size_t index_of(int column, int row) const {
    return static_cast<std::size_t>((row - first_row_) * width_ + column - first_column_);
  }
  int samples(std::size_t cell) const { return count_[cell]; }
  bool spent(std::size_t cell) const { return count_[cell] >= cap_; }
  const float* mean(std::size_t cell) const { return &mean_[cell * columns_]; }
  Label label(std::size_t cell, int sample) const {
    return sample == 0 ? first_label_[cell] : more_labels(cell)[sample - 1];
  }
  bool mixed(std::size_t cell) const;

  /// Adds the variance of the sub-element's mean in every column to `variance`, times `factor`. Where there
  /// is one sample, the spread is taken from its differences to the four neighbours: half their mean square,
  /// which holds the trend between cells too and so errs upwards. False where there is no neighbour either.
  bool add_variance(std::size_t cell, double factor, std::span<double> variance) const;
  /// The four neighbours there are.
  int neighbours(std::size_t cell, std::size_t (&out)[4]) const;

  /// Sub-elements there are, for the counts: total, and how many samples each pixel and the halo took.
  void count_samples(TileResult& result) const;

 private:
  const Label* more_labels(std::size_t cell) const {
    return &labels_[active_[cell] * static_cast<std::size_t>(cap_ - 1)];
  }
  void draw(const std::vector<std::uint32_t>& cells, Field& field);
  /// Whether an average is further from another than is allowed, in a judged column.
  bool differs(const float* own, const float* theirs) const;
  /// Sub-elements that may be refined and differ from one of their 8 neighbours, in order: after the first samples, and
  /// because of averages that the last draw moved.
  std::vector<std::uint32_t> first_marked() const;
  std::vector<std::uint32_t> newly_marked(const std::vector<std::uint32_t>& drawn) const;
  Point2 within(int column, int row, int sample) const;

  const SubElementLattice& lattice_;
  const AdaptiveOptions& options_;
  const TileProblem& problem_;
  ValueBatch batch_;
  int cap_;                                        // samples per sub-element
  int first_column_, first_row_, width_, height_;  // of all sub-elements held
  int refine_x0_, refine_y0_, refine_x1_,
      refine_y1_;  // [x0, x1) x [y0, y1), counted from the first: may be refined
  std::size_t columns_ = 0;
  std::vector<int> pixel_column_, pixel_row_;  // of each column and row of sub-elements
  std::vector<Point2> points_;                 // within a sub-element, by number of the sample
  std::vector<int> judged_;                    // columns that decide
  std::vector<int> count_;                     // samples drawn
  std::vector<float> mean_;                    // running averages, one row of columns a sub-element
  std::vector<Label> first_label_;
  std::vector<std::uint32_t> active_;  // number among the refined ones; kInactive
  std::vector<float> spread_;          // sums of squared deviations, one row a refined sub-element
  std::vector<Label> labels_;          // second and later labels, cap - 1 a refined sub-element
  std::vector<std::uint8_t> changed_;  // average moved in the last round
};

}  // namespace ifov::sampling
