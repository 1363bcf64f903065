#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/run_state/run_plan.h"
#include "sampling/reason_words.h"

namespace ifov::io {

class TileIndex;

/// What is known of a run's finished tiles.
struct TilesDone {
  std::vector<bool> done;  ///< by tile
  std::int64_t pixels = 0, converged = 0, rays = 0;
  sampling::ReasonCounts reasons{};  ///< pixels that are not converged
  double worst_ratio = 0.0;
  double elapsed_s = 0.0;  ///< wall time of all its starts
  std::size_t count() const;
};

/// The tiles of a run that may be at work, by their headers; noted in `index` where it is given.
TilesDone survey_tiles(const std::filesystem::path& folder, const RunPlan& plan, TileIndex* index = nullptr);

}  // namespace ifov::io
