#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// kLooseCell in narrow features, whose cells err alike.
constexpr double kLooseNarrowCell = 0.05;

}  // namespace

void EdgeTracer::grow() {
  std::vector<std::uint32_t>&level = level_, &awaiting = awaiting_;
  while (!new_cells_.empty()) {
    give_up_clutter();
    trace_vertices();
    notice_hanging_nodes();
    split_beside_hanging_nodes();
    if (!pending_points_.empty() || !split_cells_.empty()) continue;

    level.clear();
    level.swap(new_cells_);
    awaiting.clear();
    const std::size_t first_bracket = brackets_.size();
    for (std::uint32_t cell : level)
      if (cells_[cell].kind == CellKind::fresh) classify(cell, awaiting);
    active_.resize(brackets_.size() - first_bracket);
    std::iota(active_.begin(), active_.end(), static_cast<std::uint32_t>(first_bracket));
    locate();
    for (std::uint32_t index : awaiting) {
      if (cells_[index].kind == CellKind::junction) {
        const Junction& junction = junctions_[cells_[index].chord];
        if (std::any_of(junction.bracket, junction.bracket + 3,
                        [&](std::uint32_t b) { return brackets_[b].third_label; })) {
          suspect_[cells_[index].pixel] = 1;
          settle_complex(index);
        } else {
          stir(cells_[index].pixel);
          open_junctions_.push_back(index);
        }
        continue;
      }
      const Curve& curve = curves_[cells_[index].chord];
      if (brackets_[curve.bracket[0]].third_label || brackets_[curve.bracket[1]].third_label) {
        suspect_[cells_[index].pixel] = 1;
        settle_complex(index);
      } else {
        cells_[index].kind = CellKind::tentative;
        stir(cells_[index].pixel);
        tentative_.push_back(index);
      }
    }
  }
}

void EdgeTracer::classify(std::uint32_t index, std::vector<std::uint32_t>& awaiting) {
  Cell& cell = cells_[index];
  const std::int32_t side = Lattice::side(cell.level);
  if (cell.level == 0) {
    const std::uint32_t* above = &root_vertices_[root_vertex(cell.x, cell.y)];
    const std::uint32_t* below = above + lattice_.columns() + 1;
    const std::uint32_t corner[4] = {above[0], above[1], below[1], below[0]};
    std::copy_n(corner, 4, cell.corner);
  } else {
    for (int i = 0; i < 4; ++i)
      cell.corner[i] = known_vertex(cell.x + kCornerX[i] * side, cell.y + kCornerY[i] * side);
  }
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
  list_edge_cell(index);
  stir(cell.pixel);
  if (abandoned_[cell.pixel]) {
    cell.kind = CellKind::complex;
    return;
  }
  const double area = lattice_.side_px(cell.level) * lattice_.side_px(cell.level);
  const double error = kUniformSpread * area * contrast_.among(cell.pixel, cell.corner);
  const bool negligible = error < 0.1 * kLooseCell * std::sqrt(allowed_variance_[cell.pixel]);
  if (!two_labels && crossings == 3 && error > kLooseCell * std::sqrt(allowed_variance_[cell.pixel])) {
    make_junction(index, crossed);
    awaiting.push_back(index);
    return;
  }
  if (!two_labels || crossings != 2 || (negligible && !narrow_corner(cell))) {
    // Two things that look alike, met side by side: another may lie between them and show at no corner.
    if ((two_labels && crossings == 4) || (negligible && cell.level == 0)) suspect_[cell.pixel] = 1;
    settle_complex(index);
    return;
  }
  cell.chord = static_cast<std::uint32_t>(curves_.size());
  Curve& curve = curves_.emplace_back();
  curve.cell = index;
  for (int t = 0; t < 2; ++t) curve.side[t] = static_cast<std::uint8_t>(crossed[t]);
  curve.inner = cell.corner[(crossed[0] + 1) % 4];
  curve.outer = cell.corner[crossed[0]];
  for (int t = 0; t < 2; ++t) {
    curve.bracket[t] = bracket_on(cell, crossed[t]);
    end_in(curve.bracket[t], index);
  }
  awaiting.push_back(index);
}

/// Notes that a border which crosses this bracket goes on in the cell.
void EdgeTracer::end_in(std::uint32_t bracket, std::uint32_t index) {
  std::uint32_t* cells = brackets_[bracket].cells;
  const bool first_is_dead = cells[0] == 0 || cells_[cells[0] - 1].kind == CellKind::split;
  cells[first_is_dead ? 0 : 1] = index + 1;
}

void EdgeTracer::settle_complex(std::uint32_t index) {
  Cell& cell = cells_[index];
  const double side_px = lattice_.side_px(cell.level);
  const double error = kUniformSpread * side_px * side_px * contrast_.among(cell.pixel, cell.corner);
  const double allowed = std::sqrt(allowed_variance_[cell.pixel]);
  const bool must_follow = side_px > options_.thinnest_px && error > kLooseNarrowCell * allowed &&
                           has_two_labels(cell) && narrow_corner(cell);
  cell.kind = CellKind::complex;
  stir(cell.pixel);
  if (cell.level < kMaxLevel && !abandoned_[cell.pixel] && (must_follow || error > kLooseCell * allowed))
    split(index);
}

/// The label of a vertex, where it is known.
std::uint32_t EdgeTracer::label_if_known(std::int32_t x, std::int32_t y) const {
  if (x < 0 || y < 0 || x > lattice_.width() || y > lattice_.height()) return kNoLabel;
  if (on_lattice(x, y)) return root_vertices_[root_vertex(x, y)];
  const std::uint32_t fine = vertex_index_.find(Lattice::vertex_key(x, y));
  return fine == FlatMap::kAbsent ? kNoLabel : fine_vertices_[fine];
}

/// Whether some corner of the cell lies in a feature no wider than two cells: the next vertices of the same
/// spacing, on both sides along a lattice line, are known and unlike it.
bool EdgeTracer::narrow_corner(const Cell& cell) const {
  const std::int32_t side = Lattice::side(cell.level);
  for (int i = 0; i < 4; ++i) {
    const std::int32_t x = cell.x + kCornerX[i] * side, y = cell.y + kCornerY[i] * side;
    const auto unlike = [&](std::int32_t nx, std::int32_t ny) {
      const std::uint32_t label = label_if_known(nx, ny);
      return label != kNoLabel && label != cell.corner[i];
    };
    if ((unlike(x - side, y) && unlike(x + side, y)) || (unlike(x, y - side) && unlike(x, y + side)))
      return true;
  }
  return false;
}

/// Width of the narrowest feature that a corner of the cell lies in, by the crossings on both sides along a
/// lattice line; infinite where none is narrower than two cells.
double EdgeTracer::feature_width(const Cell& cell) const {
  const std::int32_t side = Lattice::side(cell.level);
  double narrowest = INFINITY;
  for (int i = 0; i < 4; ++i) {
    const std::int32_t x = cell.x + kCornerX[i] * side, y = cell.y + kCornerY[i] * side;
    for (const bool vertical : {false, true}) {
      const auto unlike = [&](std::int32_t step) {
        const std::uint32_t label = label_if_known(vertical ? x : x + step, vertical ? y + step : y);
        return label != kNoLabel && label != cell.corner[i];
      };
      if (!unlike(-side) || !unlike(side)) continue;
      const std::uint32_t before =
          known_bracket(vertical ? x : x - side, vertical ? y - side : y, vertical, cell.level);
      const std::uint32_t after = known_bracket(x, y, vertical, cell.level);
      double width = 0.0;
      if (before != FlatMap::kAbsent) width += brackets_[before].length_px - brackets_[before].centre();
      if (after != FlatMap::kAbsent) width += brackets_[after].centre();
      narrowest = std::min(narrowest, width);
    }
  }
  return narrowest;
}

double EdgeTracer::narrowest_met(std::uint32_t pixel) const {
  if (!crossed(pixel)) return INFINITY;
  const int k = lattice_.cells_per_pixel();
  double narrowest = INFINITY;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) {
      const Cell& cell =
          cells_[root_cell(static_cast<int>(pixel)) + static_cast<std::uint32_t>(j * lattice_.columns() + i)];
      const std::uint32_t* above = &root_vertices_[root_vertex(cell.x, cell.y)];
      const std::uint32_t* below = above + lattice_.columns() + 1;
      Cell root = cell;
      const std::uint32_t corner[4] = {above[0], above[1], below[1], below[0]};
      std::copy_n(corner, 4, root.corner);
      narrowest = std::min(narrowest, feature_width(root));
    }
  return narrowest < lattice_.side_px(0) ? narrowest : INFINITY;
}

}  // namespace ifov::sampling
