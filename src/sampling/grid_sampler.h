#pragma once

#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// N x M rays through the centres of equal sub-elements. A box footprint of side 1 or less is divided itself,
/// all rays weighing the same; under a wider footprint each pixel of the focal plane is divided once, the
/// rays are shared by the pixels around them, and each weighs the footprint's integral over its sub-element.
/// The variance is the one that random points of the same spread of values would have: an upper estimate.
class GridSampler final : public PixelSampler {
 public:
  /// Errors: std::invalid_argument where a count is below 1.
  GridSampler(int columns_per_pixel, int rows_per_pixel);
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;
  int halo_px() const override { return 0; }

 private:
  int columns_, rows_;
};

/// One ray through the centre of each element, whatever the footprint; one for each centre where those of channels are shifted. A single sample says nothing of its
/// error: there are no variances and half-widths, and no pixel counts as converged.
class SingleSampler final : public PixelSampler {
 public:
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;
  int halo_px() const override { return 0; }
};

}  // namespace ifov::sampling
