#pragma once

#include "sampling/tile.h"

namespace ifov::sampling {

/// One ray through the centre of each element, whatever the footprint. A single sample says nothing of its
/// error: there are no variances and half-widths, and no pixel counts as converged.
class SingleSampler final : public PixelSampler {
 public:
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;
  int halo_px() const override { return 0; }
};

}  // namespace ifov::sampling
