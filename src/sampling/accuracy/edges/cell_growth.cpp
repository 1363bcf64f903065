#include "sampling/accuracy/edges/cell_growth.h"

#include <algorithm>

#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/bracket_store.h"
#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/edge_cells.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/complex_cells.h"
#include "sampling/accuracy/edges/narrow_features.h"
#include "sampling/accuracy/edges/open_borders.h"

namespace ifov::sampling {

void CellGrowth::grow(OpenBorders& open) {
  tree_.take_fresh(level_);
  awaiting_.clear();
  const std::size_t first_bracket = brackets_.size();
  for (std::uint32_t cell : level_)
    if (tree_[cell].kind == CellKind::fresh) classify(cell);
  brackets_.locate(first_bracket);
  for (std::uint32_t index : awaiting_) {
    Cell& cell = tree_[index];
    const bool junction = cell.kind == CellKind::junction;
    if (junction ? met_third_label(model_.junction_of(cell).bracket)
                 : met_third_label(model_.curve_of(cell).bracket)) {
      pixels_.note_suspect(cell.pixel);
      complex_.settle(index);
      continue;
    }
    if (!junction) cell.kind = CellKind::tentative;
    pixels_.stir(cell.pixel);
    (junction ? open.junctions : open.curves).push_back(index);
  }
}

bool CellGrowth::met_third_label(std::span<const std::uint32_t> brackets) const {
  return std::any_of(brackets.begin(), brackets.end(),
                     [&](std::uint32_t b) { return brackets_[b].third_label; });
}

void CellGrowth::classify(std::uint32_t index) {
  Cell& cell = tree_[index];
  tree_.corner_labels(cell, cell.corner);
  int crossed[4], crossings = 0;
  bool two_labels = true;
  std::uint32_t other = cell.corner[0];
  for (int e = 0; e < 4; ++e) {
    if (cell.corner[e] != cell.corner[(e + 1) % 4]) crossed[crossings++] = e;
    if (cell.corner[e] != cell.corner[0]) {
      if (other != cell.corner[0] && other != cell.corner[e]) two_labels = false;
      other = cell.corner[e];
    }
  }
  if (crossings == 0) {
    cell.kind = CellKind::uniform;
    return;
  }
  edge_cells_.add(cell.pixel, index);
  pixels_.stir(cell.pixel);
  if (pixels_.abandoned(cell.pixel)) {
    cell.kind = CellKind::complex;
    return;
  }
  const double side_px = tree_.lattice().side_px(cell.level), area = side_px * side_px;
  const double error = kUniformSpread * area * contrast_.among(cell.pixel, cell.corner);
  const double allowed = pixels_.allowed_deviation(cell.pixel);
  const bool negligible = error < 0.1 * kLooseCell * allowed;
  if (!two_labels && crossings == 3 && error > kLooseCell * allowed) {
    put_junction(index, crossed);
    return;
  }
  if (!two_labels || crossings != 2 || (negligible && !features_.has_corner_of(cell))) {
    // Two things that look alike, met side by side: another may lie between them and show at no corner.
    if ((two_labels && crossings == 4) || (negligible && cell.level == 0)) pixels_.note_suspect(cell.pixel);
    complex_.settle(index);
    return;
  }
  put_curve(index, crossed);
}

void CellGrowth::put_curve(std::uint32_t index, const int crossed[2]) {
  Cell& cell = tree_[index];
  Curve curve;
  curve.cell = index;
  curve.inner = cell.corner[(crossed[0] + 1) % 4];
  curve.outer = cell.corner[crossed[0]];
  for (int t = 0; t < 2; ++t) {
    curve.side[t] = static_cast<std::uint8_t>(crossed[t]);
    curve.bracket[t] = brackets_.enter(index, crossed[t]);
  }
  cell.chord = model_.add(curve);
  awaiting_.push_back(index);
}

void CellGrowth::put_junction(std::uint32_t index, const int crossed[3]) {
  Cell& cell = tree_[index];
  Junction junction;
  junction.cell = index;
  for (int i = 0; i < 3; ++i) {
    junction.side[i] = static_cast<std::uint8_t>(crossed[i]);
    junction.sector[i] = cell.corner[(crossed[i] + 1) % 4];
    junction.bracket[i] = brackets_.enter(index, crossed[i]);
  }
  cell.chord = model_.add(junction);
  cell.kind = CellKind::junction;
  awaiting_.push_back(index);
}

}  // namespace ifov::sampling
