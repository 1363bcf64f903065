#include "sampling/accuracy/borders/cell_tree.h"

#include <algorithm>

#include "sampling/accuracy/borders/point_queries.h"
#include "sampling/accuracy/borders/traced_pixels.h"

namespace ifov::sampling {

namespace {

/// From a side's middle to a fine position in the cell beyond.
constexpr int kBeyondX[4] = {0, 0, 0, -1}, kBeyondY[4] = {-1, 0, 0, 0};

}  // namespace

void CellTree::plant(std::span<const std::uint32_t> vertex_labels) {
  const int columns = lattice_.columns(), rows = lattice_.rows(), k = lattice_.cells_per_pixel();
  const std::size_t row = static_cast<std::size_t>(columns) + 1;
  root_labels_.assign(vertex_labels.begin(), vertex_labels.end());
  cells_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  Cell* cell = cells_.data();
  for (int j = 0; j < rows; ++j) {
    const std::uint32_t* above = &root_labels_[static_cast<std::size_t>(j) * row];
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
        fresh_cells_.push_back(static_cast<std::uint32_t>(cell - cells_.data()));
      }
    }
  }
}

void CellTree::add_cell(std::int32_t x, std::int32_t y, int level) {
  Cell cell;
  cell.x = x;
  cell.y = y;
  cell.level = static_cast<std::uint8_t>(level);
  cell.pixel = static_cast<std::uint32_t>(lattice_.pixel_of_cell(x, y));
  fresh_cells_.push_back(static_cast<std::uint32_t>(cells_.size()));
  cells_.push_back(cell);
}

std::uint32_t CellTree::find_leaf(std::int32_t x, std::int32_t y) const {
  std::uint32_t cell =
      static_cast<std::uint32_t>((y / Lattice::side(0)) * lattice_.columns() + x / Lattice::side(0));
  while (cells_[cell].kind == CellKind::split) {
    const Cell& c = cells_[cell];
    const std::int32_t half = Lattice::side(c.level + 1);
    cell = c.children + (x >= c.x + half) + 2 * (y >= c.y + half);
  }
  return cell;
}

std::uint32_t CellTree::leaf_at(FocalPoint point) const {
  const PixelRect& domain = lattice_.domain();
  const auto fine = [&](double at, int origin, std::int32_t limit) {
    return std::clamp(static_cast<std::int32_t>((at - origin) / lattice_.unit_px()), 0, limit - 1);
  };
  return find_leaf(fine(point.x_px, domain.x0, lattice_.width()),
                   fine(point.y_px, domain.y0, lattice_.height()));
}

void CellTree::corner_labels(const Cell& cell, std::uint32_t corner[4]) const {
  if (cell.level == 0) {
    const std::uint32_t* above = &root_labels_[lattice_.vertex_number(cell.x, cell.y)];
    const std::uint32_t* below = above + lattice_.columns() + 1;
    corner[0] = above[0];
    corner[1] = above[1];
    corner[2] = below[1];
    corner[3] = below[0];
    return;
  }
  const std::int32_t side = Lattice::side(cell.level);
  for (int i = 0; i < 4; ++i)
    corner[i] = known_label(cell.x + kCornerX[i] * side, cell.y + kCornerY[i] * side);
}

std::uint32_t CellTree::label_if_known(std::int32_t x, std::int32_t y) const {
  if (x < 0 || y < 0 || x > lattice_.width() || y > lattice_.height()) return kNoLabel;
  if (Lattice::on_lattice(x, y)) return root_labels_[lattice_.vertex_number(x, y)];
  const std::uint32_t fine = vertex_index_.find(Lattice::vertex_key(x, y));
  return fine == FlatMap::kAbsent ? kNoLabel : fine_labels_[fine];
}

/// Makes sure that the label of a position will be known once vertices have been traced.
void CellTree::want_vertex(std::int32_t x, std::int32_t y) {
  if (Lattice::on_lattice(x, y)) return;
  const std::uint32_t fresh = static_cast<std::uint32_t>(fine_labels_.size());
  if (vertex_index_.find_or_insert(Lattice::vertex_key(x, y), fresh) != fresh) return;
  fine_labels_.push_back(kNoLabel);
  pending_.push_back(lattice_.point(x, y));
}

void CellTree::trace_vertices() {
  if (pending_.empty()) return;
  const std::size_t first = fine_labels_.size() - pending_.size();
  queries_.points().swap(pending_);
  const std::vector<std::uint32_t>& seen = queries_.ask();
  std::copy(seen.begin(), seen.end(), fine_labels_.begin() + static_cast<std::ptrdiff_t>(first));
}

void CellTree::split(std::uint32_t index) {
  const Cell parent = cells_[index];
  if (parent.kind == CellKind::split || parent.level == kMaxLevel) return;
  const std::int32_t half = Lattice::side(parent.level + 1);
  const std::uint32_t children = static_cast<std::uint32_t>(cells_.size());
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) add_cell(parent.x + i * half, parent.y + j * half, parent.level + 1);
  cells_[index].kind = CellKind::split;
  pixels_.stir(cells_[index].pixel);
  cells_[index].children = children;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) want_vertex(parent.x + i * half, parent.y + j * half);
  split_cells_.push_back(index);
}

bool CellTree::look_at_vertices() {
  trace_vertices();
  notice_hanging_nodes();
  split_beside_hanging_nodes();
  return pending_.empty() && split_cells_.empty();
}

void CellTree::notice_hanging_nodes() {
  for (std::uint32_t index : split_cells_) {
    const Cell& cell = cells_[index];
    const std::int32_t side = Lattice::side(cell.level);
    for (int e = 0; e < 4; ++e) {
      const int f = (e + 1) % 4;
      const std::int32_t ax = cell.x + kCornerX[e] * side, ay = cell.y + kCornerY[e] * side;
      const std::int32_t bx = cell.x + kCornerX[f] * side, by = cell.y + kCornerY[f] * side;
      const std::int32_t mx = (ax + bx) / 2, my = (ay + by) / 2;
      const std::uint32_t a = known_label(ax, ay), b = known_label(bx, by), m = known_label(mx, my);
      if (m == a || m == b) continue;
      const std::int32_t ox = mx + kBeyondX[e], oy = my + kBeyondY[e];
      if (ox < 0 || oy < 0 || ox >= lattice_.width() || oy >= lattice_.height()) continue;
      pixels_.note_suspect(cell.pixel);
      hanging_.push_back({ox, oy, cell.level});
    }
  }
  split_cells_.clear();
}

void CellTree::split_beside_hanging_nodes() {
  std::vector<HangingNode> left;
  for (const HangingNode& node : hanging_) {
    const std::uint32_t leaf = find_leaf(node.x, node.y);
    const Cell& cell = cells_[leaf];
    if (cell.level > node.level || pixels_.abandoned(cell.pixel)) continue;
    pixels_.note_followed(cell.pixel, cell.level + 1);
    split(leaf);
    left.push_back(node);
  }
  hanging_.swap(left);
}

}  // namespace ifov::sampling
