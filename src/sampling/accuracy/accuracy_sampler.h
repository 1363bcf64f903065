#pragma once

#include "sampling/accuracy/basis/options.h"
#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"

namespace ifov::sampling {

class AccuracyParts;

/// Finds the rays that each pixel needs for the accuracy that the user states, and says how accurate it is.
///
/// Borders between labels are traced over a lattice shared by all pixels of the tile; the radiance inside
/// each label is estimated from stratified paths; the footprint (PSF and detector) weights the traced model,
/// so that no ray is drawn from it. Two statements come out: an interval for what was resolved, and how large
/// a compact feature could have been missed (missable_fraction). docs/theory/accuracy_sampler.md derives
/// both.
class AccuracySampler : public PixelSampler {
 public:
  /// Cells of the lattice along a side of a pixel, and of a tile with what a PSF reaches beside it, at most.
  static constexpr int kMostLattice = 32, kMostCells = 1 << 14;

  /// Errors: std::invalid_argument where an option is out of its range (lattice 1..kMostLattice, probes 0..16).
  explicit AccuracySampler(AccuracyOptions options = {});

  /// Errors: std::invalid_argument without a tolerance, a footprint or steering channels, or with a tile of too many cells; Cancelled.
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;

  /// One pixel, so that the pixels beside a tile's rim are traced as they are in the neighbouring tile.
  int halo_px() const override { return 1; }

  /// Rays that are drawn from the footprint leave nothing to go on from.
  bool can_refine() const override { return options_.footprint_by_model; }

  bool takes_many_values() const override { return true; }

  const AccuracyOptions& options() const { return options_; }

 protected:
  /// Of which the method is made.
  virtual const AccuracyParts& parts() const;

 private:
  AccuracyOptions options_;
};

}  // namespace ifov::sampling
