#pragma once

#include <algorithm>
#include <cmath>

#include "sampling/tile.h"

namespace ifov::sampling {

/// The source pixels that a tile looks at: those its footprints reach and `halo` more, within the image grown
/// by the footprint's reach.
inline PixelRect source_domain(const TileProblem& problem, int halo) {
  const int reach =
      std::max(0, static_cast<int>(std::ceil(problem.footprint->half_width_px() - 0.5 - 1e-12)));
  const PixelRect &t = problem.tile, &i = problem.image;
  return {std::max(t.x0 - reach - halo, i.x0 - reach), std::max(t.y0 - reach - halo, i.y0 - reach),
          std::min(t.x1 + reach + halo, i.x1 + reach), std::min(t.y1 + reach + halo, i.y1 + reach)};
}

}  // namespace ifov::sampling
