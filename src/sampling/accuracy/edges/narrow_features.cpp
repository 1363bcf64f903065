#include "sampling/accuracy/edges/narrow_features.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/bracket_store.h"
#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/traced_pixels.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed standard error by which a pixel all of one label may be off where it is taken for another that looks alike.
constexpr double kAlike = 0.1;
/// In spacings of the lattice: what is wider at the next vertex is no narrow feature.
constexpr double kWide = 0.5;

}  // namespace

bool NarrowFeatures::look_alike(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const {
  return a == b || contrast_(pixel, a, b) < kAlike * pixels_.allowed_deviation(pixel);
}

NarrowFeatures::Place NarrowFeatures::corner_of(const Cell& cell, int corner) const {
  const std::int32_t side = Lattice::side(cell.level);
  return {cell.pixel, cell.corner[corner], cell.x + kCornerX[corner] * side, cell.y + kCornerY[corner] * side,
          cell.level};
}

/// How far along a lattice line, px, what lies at a vertex goes on before the label changes; infinite where the next
/// vertex on that line looks alike or is not known. Beside a larger cell, which the vertex is a corner of, the next vertex is that
/// cell's.
double NarrowFeatures::reach(const Place& place, bool vertical, bool forward) const {
  const std::int32_t x = place.x, y = place.y;
  for (int level = place.level; level >= 0; --level) {
    const std::int32_t side = Lattice::side(level), step = forward ? side : -side;
    if (((vertical ? y : x) & (side - 1)) != 0) return INFINITY;
    const std::uint32_t next = tree_.label_if_known(vertical ? x : x + step, vertical ? y + step : y);
    if (next == kNoLabel) continue;
    if (look_alike(place.pixel, next, place.label)) return INFINITY;
    const std::int32_t low = forward ? 0 : side;
    const std::uint32_t found =
        brackets_.find(vertical ? x : x - low, vertical ? y - low : y, vertical, level);
    if (found == FlatMap::kAbsent) return 0.0;
    const Bracket& bracket = brackets_[found];
    return forward ? bracket.centre() : bracket.length_px - bracket.centre();
  }
  return INFINITY;
}

double NarrowFeatures::width_across(const Place& place, bool vertical) const {
  return reach(place, vertical, false) + reach(place, vertical, true);
}

bool NarrowFeatures::has_corner_of(const Cell& cell) const {
  const double side_px = tree_.lattice().side_px(cell.level);
  for (int i = 0; i < 4; ++i)
    for (const bool vertical : {false, true}) {
      const Place place = corner_of(cell, i);
      if (reach(place, vertical, false) <= side_px && reach(place, vertical, true) <= side_px) return true;
    }
  return false;
}

double NarrowFeatures::width_at(const Cell& cell) const {
  double narrowest = INFINITY;
  for (int i = 0; i < 4; ++i)
    for (const bool vertical : {false, true})
      narrowest = std::min(narrowest, width_across(corner_of(cell, i), vertical));
  return narrowest;
}

/// Of a disc that reaches just beyond a vertex a lattice line shows a short chord, and the vertex behind that it is wide.
bool NarrowFeatures::is_rim(const Place& vertex, bool vertical, double width_px) const {
  const std::int32_t side = Lattice::side(vertex.level);
  for (const bool forward : {false, true}) {
    if (reach(vertex, !vertical, !forward) > width_px || reach(vertex, !vertical, forward) != INFINITY)
      continue;
    Place behind = vertex;
    (vertical ? behind.x : behind.y) += forward ? side : -side;
    behind.label = tree_.label_if_known(behind.x, behind.y);
    if (behind.label != kNoLabel &&
        width_across(behind, vertical) > kWide * tree_.lattice().side_px(vertex.level))
      return true;
  }
  return false;
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
      for (int corner = 0; corner < 4; ++corner)
        for (const bool vertical : {false, true}) {
          const Place vertex = corner_of(root, corner);
          const double width = width_across(vertex, vertical);
          if (width < narrowest && !is_rim(vertex, vertical, width)) narrowest = width;
        }
    }
  return narrowest < lattice.side_px(0) ? narrowest : INFINITY;
}

}  // namespace ifov::sampling
