#include "sampling/accuracy/edges/narrow_features.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/bracket_store.h"
#include "sampling/accuracy/borders/cell_tree.h"

namespace ifov::sampling {

/// How far along a lattice line, px, what lies at a cell's corner goes on before the label changes; infinite where the next
/// vertex on that line is alike or not known. Beside a larger cell, which the corner is a corner of, the next vertex is that
/// cell's.
double NarrowFeatures::reach(const Cell& cell, int corner, bool vertical, bool forward) const {
  const std::int32_t own_side = Lattice::side(cell.level);
  const std::int32_t x = cell.x + kCornerX[corner] * own_side, y = cell.y + kCornerY[corner] * own_side;
  for (int level = cell.level; level >= 0; --level) {
    const std::int32_t side = Lattice::side(level), step = forward ? side : -side;
    if (((vertical ? y : x) & (side - 1)) != 0) return INFINITY;
    const std::uint32_t next = tree_.label_if_known(vertical ? x : x + step, vertical ? y + step : y);
    if (next == kNoLabel) continue;
    if (next == cell.corner[corner]) return INFINITY;
    const std::int32_t low = forward ? 0 : side;
    const std::uint32_t found =
        brackets_.find(vertical ? x : x - low, vertical ? y - low : y, vertical, level);
    if (found == FlatMap::kAbsent) return 0.0;
    const Bracket& bracket = brackets_[found];
    return forward ? bracket.centre() : bracket.length_px - bracket.centre();
  }
  return INFINITY;
}

bool NarrowFeatures::has_corner_of(const Cell& cell) const {
  const double side_px = tree_.lattice().side_px(cell.level);
  for (int i = 0; i < 4; ++i)
    for (const bool vertical : {false, true})
      if (reach(cell, i, vertical, false) <= side_px && reach(cell, i, vertical, true) <= side_px)
        return true;
  return false;
}

double NarrowFeatures::width_at(const Cell& cell) const {
  double narrowest = INFINITY;
  for (int i = 0; i < 4; ++i)
    for (const bool vertical : {false, true})
      narrowest = std::min(narrowest, reach(cell, i, vertical, false) + reach(cell, i, vertical, true));
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
