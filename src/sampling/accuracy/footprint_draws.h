#pragma once

#include "sampling/accuracy/basis/options.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// The alternative to weighting a traced model (AccuracyOptions::footprint_by_model false): every pixel draws
/// its own paths from its footprint, in 8 scrambled nets that double until the interval from their means
/// fits. Shares nothing between pixels; there to show what sharing saves.
void draw_from_footprint(const TileProblem& problem, Field& field, const AccuracyOptions& options,
                         const AccuracyFaults& faults, TileResult& result);

}  // namespace ifov::sampling
