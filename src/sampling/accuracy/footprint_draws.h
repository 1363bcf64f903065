#pragma once

#include <cstdint>

namespace ifov::sampling {

class Field;
struct TileProblem;
struct TileResult;

/// The alternative to weighting a traced model (AccuracyOptions::footprint_by_model false): every pixel draws
/// its own paths from its footprint, in 8 scrambled nets that double until the interval from their means
/// fits, or a pixel has spent `most_samples`. Shares nothing between pixels; there to show what sharing saves.
void draw_from_footprint(const TileProblem& problem, Field& field, std::uint32_t most_samples,
                         TileResult& result);

}  // namespace ifov::sampling
