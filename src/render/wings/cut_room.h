#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/tolerance/accuracy_tolerance.h"

namespace ifov::sampling {
class Field;
struct TileProblem;
}  // namespace ifov::sampling

namespace ifov::render {

/// The darkest and the brightest that some paths meet in and about a tile, by column.
struct CutRange {
  std::vector<double> darkest, brightest;
  std::size_t paths = 0;
};

/// One path in each square of 4 x 4 pixels, as far as `reach_px` beside the tile, the image's rim or not: from there light may come by
/// way of what a PSF's cut leaves out. Throws Cancelled.
CutRange cut_range(const sampling::TileProblem& problem, double reach_px, sampling::Field& field);

/// What is asked for in one tile, with room for what a PSF's cut leaves out where nothing is added for it (widen_by_cut()): that much
/// of the energy, by column, times the largest difference to the darkest and the brightest about it.
class CutRoom final : public sampling::Tolerance {
 public:
  /// `tolerance` and `range` must outlive this.
  CutRoom(const AccuracyTolerance& tolerance, std::vector<double> left_out, const CutRange& range);

  void limits(std::span<const double> mean, std::span<double> limit) const override;
  double confidence() const override { return tolerance_.confidence(); }

 private:
  const AccuracyTolerance& tolerance_;
  std::vector<double> left_out_;  // by column
  const CutRange& range_;
  mutable std::vector<double> bounds_;  // of the pixel at hand: one tile, one thread
};

}  // namespace ifov::render
