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

/// How far along a lattice line, px, what lies at a cell's corner goes on before the label changes; infinite where the next
/// vertex on that line is alike or not known. Beside a larger cell, which the corner is a corner of, the next vertex is that
/// cell's.
double EdgeTracer::reach(std::int32_t x, std::int32_t y, bool vertical, bool forward, int level,
                         std::uint32_t label) const {
  for (; level >= 0; --level) {
    const std::int32_t side = Lattice::side(level), step = forward ? side : -side;
    if (((vertical ? y : x) & (side - 1)) != 0) return INFINITY;
    const std::uint32_t next = label_if_known(vertical ? x : x + step, vertical ? y + step : y);
    if (next == kNoLabel) continue;
    if (next == label) return INFINITY;
    const std::int32_t low = forward ? 0 : side;
    const std::uint32_t bracket =
        known_bracket(vertical ? x : x - low, vertical ? y - low : y, vertical, level);
    if (bracket == FlatMap::kAbsent) return 0.0;
    const Bracket& b = brackets_[bracket];
    return forward ? b.centre() : b.length_px - b.centre();
  }
  return INFINITY;
}

/// Whether some corner of the cell lies in a feature that ends within a cell's side on both sides along a lattice line.
bool EdgeTracer::narrow_corner(const Cell& cell) const {
  const std::int32_t side = Lattice::side(cell.level);
  const double side_px = lattice_.side_px(cell.level);
  for (int i = 0; i < 4; ++i) {
    const std::int32_t x = cell.x + kCornerX[i] * side, y = cell.y + kCornerY[i] * side;
    for (const bool vertical : {false, true})
      if (reach(x, y, vertical, false, cell.level, cell.corner[i]) <= side_px &&
          reach(x, y, vertical, true, cell.level, cell.corner[i]) <= side_px)
        return true;
  }
  return false;
}

/// Width of the narrowest feature that a corner of the cell lies in, along a lattice line; infinite where none ends on both
/// sides before the next vertices.
double EdgeTracer::feature_width(const Cell& cell) const {
  const std::int32_t side = Lattice::side(cell.level);
  double narrowest = INFINITY;
  for (int i = 0; i < 4; ++i) {
    const std::int32_t x = cell.x + kCornerX[i] * side, y = cell.y + kCornerY[i] * side;
    for (const bool vertical : {false, true})
      narrowest = std::min(narrowest, reach(x, y, vertical, false, cell.level, cell.corner[i]) +
                                          reach(x, y, vertical, true, cell.level, cell.corner[i]));
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
