#include "sampling/accuracy/source_grid.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/basis/lattice.h"
#include "sampling/footprint_groups.h"
#include "sampling/tile.h"

namespace ifov::sampling {

PixelRect source_domain(const TileProblem& problem, int reach, int halo) {
  const PixelRect &t = problem.tile, &i = problem.image;
  return {std::max(t.x0 - reach - halo, i.x0 - reach), std::max(t.y0 - reach - halo, i.y0 - reach),
          std::min(t.x1 + reach + halo, i.x1 + reach), std::min(t.y1 + reach + halo, i.y1 + reach)};
}

int SourceGrid::nearest_output(int source) const {
  const PixelRect& d = lattice_.domain();
  const int x = std::clamp(d.x0 + source % d.width(), tile_.x0, tile_.x1 - 1) - tile_.x0;
  const int y = std::clamp(d.y0 + source / d.width(), tile_.y0, tile_.y1 - 1) - tile_.y0;
  return y * tile_.width() + x;
}

int SourceGrid::source_of(int output) const {
  const PixelRect& d = lattice_.domain();
  return (tile_.y0 + output / tile_.width() - d.y0) * d.width() + tile_.x0 + output % tile_.width() - d.x0;
}

double SourceGrid::relative_weight(int source) const {
  const PixelRect& d = lattice_.domain();
  const int x = d.x0 + source % d.width(), y = d.y0 + source / d.width();
  const int dx = x - std::clamp(x, tile_.x0, tile_.x1 - 1), dy = y - std::clamp(y, tile_.y0, tile_.y1 - 1);
  if (dx == 0 && dy == 0) return 1.0;
  double most = 0.0;
  // Where footprints lie otherwise in other columns, one further away may reach further.
  const int nearest = x - dx, further = footprints_.by_column() ? footprints_.reach() : 0;
  for (int i = std::max(tile_.x0, nearest - further); i <= std::min(tile_.x1 - 1, nearest + further); ++i)
    for (std::size_t group = 0; group < footprints_.groups(); ++group)
      most = std::max(most, footprints_.integral(group, i, x - i - 0.5, dy - 0.5, x - i + 0.5, dy + 0.5) /
                                footprints_.footprint(group).integral(-0.5, -0.5, 0.5, 0.5));
  return std::min(most, 1.0);
}

}  // namespace ifov::sampling
