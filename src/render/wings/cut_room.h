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

/// What is asked for in one tile, with room for what a PSF's cut leaves out where nothing is added for it (widen_by_cut()): that much
/// of the energy, by column, times the largest difference to the tile's darkest and brightest, as some paths have met them.
class CutRoom final : public sampling::Tolerance {
 public:
  /// One path in each square of kSide x kSide pixels. `tolerance` must outlive this. Throws Cancelled.
  CutRoom(const AccuracyTolerance& tolerance, std::vector<double> left_out,
          const sampling::TileProblem& problem, sampling::Field& field);

  void limits(std::span<const double> mean, std::span<double> limit) const override;
  double confidence() const override { return tolerance_.confidence(); }

  static constexpr int kSide = 4;
  std::size_t paths() const { return paths_; }

 private:
  const AccuracyTolerance& tolerance_;
  std::vector<double> left_out_, darkest_, brightest_;  // by column
  std::size_t paths_ = 0;
  mutable std::vector<double> bounds_;  // of the pixel at hand: one tile, one thread
};

}  // namespace ifov::render
