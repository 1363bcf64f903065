#include "sampling/accuracy/edges/complex_cells.h"

#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/narrow_features.h"

namespace ifov::sampling {

namespace {

/// kLooseCell in narrow features, whose cells err alike.
constexpr double kLooseNarrowCell = 0.05;

}  // namespace

void ComplexCells::settle(std::uint32_t index) {
  Cell& cell = tree_[index];
  const double side_px = tree_.lattice().side_px(cell.level);
  const double error = kUniformSpread * side_px * side_px * contrast_.among(cell.pixel, cell.corner);
  const double allowed = pixels_.allowed_deviation(cell.pixel);
  const bool must_follow = side_px > thinnest_px_ && error > kLooseNarrowCell * allowed &&
                           has_two_labels(cell) && features_.has_corner_of(cell);
  cell.kind = CellKind::complex;
  pixels_.stir(cell.pixel);
  if (cell.level < kMaxLevel && !pixels_.abandoned(cell.pixel) &&
      (must_follow || error > kLooseCell * allowed))
    tree_.split(index);
}

}  // namespace ifov::sampling
