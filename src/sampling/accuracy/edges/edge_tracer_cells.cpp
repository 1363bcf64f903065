#include <algorithm>

#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// From a side's middle to a fine position in the cell beyond.
constexpr int kBeyondX[4] = {0, 0, 0, -1}, kBeyondY[4] = {-1, 0, 0, 0};

}  // namespace

void EdgeTracer::plant(std::span<const std::uint32_t> vertex_labels) {
  const int columns = lattice_.columns(), rows = lattice_.rows(), k = lattice_.cells_per_pixel();
  const std::size_t row = static_cast<std::size_t>(columns) + 1;
  root_vertices_.assign(vertex_labels.begin(), vertex_labels.end());
  root_brackets_.assign(2 * root_vertices_.size(), FlatMap::kAbsent);
  cells_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  Cell* cell = cells_.data();
  for (int j = 0; j < rows; ++j) {
    const std::uint32_t* above = &root_vertices_[static_cast<std::size_t>(j) * row];
    const std::uint32_t* below = above + row;
    std::uint32_t pixel = static_cast<std::uint32_t>(j / k * lattice_.domain().width());
    for (int i = 0, inside = 0; i < columns; ++i, ++cell) {
      cell->x = i * Lattice::side(0);
      cell->y = j * Lattice::side(0);
      cell->pixel = pixel;
      if (++inside == k) inside = 0, ++pixel;
      if (above[i] == above[i + 1] && above[i] == below[i] && above[i] == below[i + 1]) {
        std::fill_n(cell->corner, 4, above[i]);
        cell->kind = CellKind::uniform;
      } else {
        new_cells_.push_back(static_cast<std::uint32_t>(cell - cells_.data()));
      }
    }
  }
  // Most of these cells get one curve, and share its two crossings with their neighbours.
  const std::size_t crossed = new_cells_.size() + new_cells_.size() / 8;
  curves_.reserve(crossed);
  brackets_.reserve(crossed);
  edge_cells_.reserve(crossed);
}

std::uint32_t EdgeTracer::push_cell(std::int32_t x, std::int32_t y, int level) {
  Cell cell;
  cell.x = x;
  cell.y = y;
  cell.level = static_cast<std::uint8_t>(level);
  cell.pixel = static_cast<std::uint32_t>(lattice_.pixel_of_cell(x, y));
  cells_.push_back(cell);
  const std::uint32_t index = static_cast<std::uint32_t>(cells_.size() - 1);
  new_cells_.push_back(index);
  return index;
}

std::uint32_t EdgeTracer::find_leaf(std::int32_t x, std::int32_t y) const {
  std::uint32_t cell =
      static_cast<std::uint32_t>((y / Lattice::side(0)) * lattice_.columns() + x / Lattice::side(0));
  while (cells_[cell].kind == CellKind::split) {
    const Cell& c = cells_[cell];
    const std::int32_t half = Lattice::side(c.level + 1);
    cell = c.children + (x >= c.x + half) + 2 * (y >= c.y + half);
  }
  return cell;
}

std::uint32_t EdgeTracer::leaf_at(FocalPoint point) const {
  const PixelRect& domain = lattice_.domain();
  const auto fine = [&](double at, int origin, std::int32_t limit) {
    return std::clamp(static_cast<std::int32_t>((at - origin) / lattice_.unit_px()), 0, limit - 1);
  };
  return find_leaf(fine(point.x_px, domain.x0, lattice_.width()),
                   fine(point.y_px, domain.y0, lattice_.height()));
}

/// Adds a cell that a border crosses to its pixel's list, behind the others.
void EdgeTracer::list_edge_cell(std::uint32_t cell) {
  const auto entry = static_cast<std::uint32_t>(edge_cells_.size());
  edge_cells_.push_back({cell, kNone});
  EdgeCellList& list = edge_lists_[cells_[cell].pixel];
  (list.last == kNone ? list.first : edge_cells_[list.last].next) = entry;
  list.last = entry;
}

/// Makes sure that the label of a position will be known once vertices have been traced.
void EdgeTracer::vertex(std::int32_t x, std::int32_t y) {
  if (on_lattice(x, y)) return;
  const std::uint32_t fresh = static_cast<std::uint32_t>(fine_vertices_.size());
  if (vertex_index_.find_or_insert(Lattice::vertex_key(x, y), fresh) != fresh) return;
  fine_vertices_.push_back(kNoLabel);
  pending_points_.push_back(lattice_.point(x, y));
}

void EdgeTracer::trace_vertices() {
  if (pending_points_.empty()) return;
  const std::size_t first = fine_vertices_.size() - pending_points_.size();
  points_.swap(pending_points_);
  ask(seen_);
  pending_points_.clear();
  std::copy(seen_.begin(), seen_.end(), fine_vertices_.begin() + first);
}

void EdgeTracer::split(std::uint32_t index) {
  const Cell parent = cells_[index];
  if (parent.kind == CellKind::split || parent.level == kMaxLevel) return;
  const std::int32_t half = Lattice::side(parent.level + 1);
  const std::uint32_t children = static_cast<std::uint32_t>(cells_.size());
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) push_cell(parent.x + i * half, parent.y + j * half, parent.level + 1);
  cells_[index].kind = CellKind::split;
  stir(cells_[index].pixel);
  cells_[index].children = children;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) vertex(parent.x + i * half, parent.y + j * half);
  split_cells_.push_back(index);
}

void EdgeTracer::notice_hanging_nodes() {
  for (std::uint32_t index : split_cells_) {
    const Cell& cell = cells_[index];
    const std::int32_t side = Lattice::side(cell.level);
    for (int e = 0; e < 4; ++e) {
      const int f = (e + 1) % 4;
      const std::int32_t ax = cell.x + kCornerX[e] * side, ay = cell.y + kCornerY[e] * side;
      const std::int32_t bx = cell.x + kCornerX[f] * side, by = cell.y + kCornerY[f] * side;
      const std::int32_t mx = (ax + bx) / 2, my = (ay + by) / 2;
      const std::uint32_t a = known_vertex(ax, ay), b = known_vertex(bx, by), m = known_vertex(mx, my);
      if (m == a || m == b) continue;
      const std::int32_t ox = mx + kBeyondX[e], oy = my + kBeyondY[e];
      if (ox < 0 || oy < 0 || ox >= lattice_.width() || oy >= lattice_.height()) continue;
      suspect_[cell.pixel] = 1;
      hanging_.push_back({ox, oy, cell.level});
    }
  }
  split_cells_.clear();
}

void EdgeTracer::split_beside_hanging_nodes() {
  std::vector<HangingNode> left;
  for (const HangingNode& node : hanging_) {
    const std::uint32_t leaf = find_leaf(node.x, node.y);
    if (cells_[leaf].level > node.level || abandoned_[cells_[leaf].pixel]) continue;
    std::uint8_t& followed = followed_[cells_[leaf].pixel];
    followed = std::max(followed, static_cast<std::uint8_t>(cells_[leaf].level + 1));
    split(leaf);
    left.push_back(node);
  }
  hanging_.swap(left);
}

}  // namespace ifov::sampling
