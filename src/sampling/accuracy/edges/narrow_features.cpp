#include "sampling/accuracy/edges/narrow_features.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/bracket_store.h"
#include "sampling/accuracy/borders/cell_tree.h"

namespace ifov::sampling {

/// Whether the label of a position is known and is not that of the cell's corner.
bool NarrowFeatures::unlike(const Cell& cell, int corner, std::int32_t x, std::int32_t y) const {
  const std::uint32_t label = tree_.label_if_known(x, y);
  return label != kNoLabel && label != cell.corner[corner];
}

bool NarrowFeatures::has_corner_of(const Cell& cell) const {
  const std::int32_t side = Lattice::side(cell.level);
  for (int i = 0; i < 4; ++i) {
    const std::int32_t x = cell.x + kCornerX[i] * side, y = cell.y + kCornerY[i] * side;
    if ((unlike(cell, i, x - side, y) && unlike(cell, i, x + side, y)) ||
        (unlike(cell, i, x, y - side) && unlike(cell, i, x, y + side)))
      return true;
  }
  return false;
}

double NarrowFeatures::width_at(const Cell& cell) const {
  const std::int32_t side = Lattice::side(cell.level);
  double narrowest = INFINITY;
  for (int i = 0; i < 4; ++i) {
    const std::int32_t x = cell.x + kCornerX[i] * side, y = cell.y + kCornerY[i] * side;
    for (const bool vertical : {false, true}) {
      const std::int32_t dx = vertical ? 0 : side, dy = vertical ? side : 0;
      if (!unlike(cell, i, x - dx, y - dy) || !unlike(cell, i, x + dx, y + dy)) continue;
      const std::uint32_t before = brackets_.find(x - dx, y - dy, vertical, cell.level);
      const std::uint32_t after = brackets_.find(x, y, vertical, cell.level);
      double width = 0.0;
      if (before != FlatMap::kAbsent) width += brackets_[before].length_px - brackets_[before].centre();
      if (after != FlatMap::kAbsent) width += brackets_[after].centre();
      narrowest = std::min(narrowest, width);
    }
  }
  return narrowest;
}

double NarrowFeatures::narrowest_met(std::uint32_t pixel) const {
  const Lattice& lattice = tree_.lattice();
  const int k = lattice.cells_per_pixel();
  const std::uint32_t first = lattice.first_cell(static_cast<int>(pixel));
  double narrowest = INFINITY;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) {
      Cell root = tree_[first + static_cast<std::uint32_t>(j * lattice.columns() + i)];
      tree_.corner_labels(root, root.corner);
      narrowest = std::min(narrowest, width_at(root));
    }
  return narrowest < lattice.side_px(0) ? narrowest : INFINITY;
}

}  // namespace ifov::sampling
