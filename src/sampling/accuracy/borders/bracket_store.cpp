#include "sampling/accuracy/borders/bracket_store.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/point_queries.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/hash.h"

namespace ifov::sampling {

namespace {

/// First width of a bracket, in units of what the tolerance allows to a crossing of one side of its cell.
constexpr double kFirstWidth = 0.3;
/// Where a lattice line is crossed on both sides of a vertex, in a narrow feature, both brackets are refined to this share of
/// their side, as long as a bracket out of place would cost kWorth of the allowed standard error.
constexpr double kThinShare = 0.125, kWorth = 0.5;

}  // namespace

void BracketStore::plant(std::size_t expected) {
  const Lattice& lattice = tree_.lattice();
  root_brackets_.assign(
      2 * static_cast<std::size_t>(lattice.columns() + 1) * static_cast<std::size_t>(lattice.rows() + 1),
      FlatMap::kAbsent);
  brackets_.reserve(expected);
}

std::size_t BracketStore::root_edge(std::int32_t x, std::int32_t y, bool vertical) const {
  return 2 * tree_.lattice().vertex_number(x, y) + vertical;
}

std::uint32_t BracketStore::enter(std::uint32_t index, int side) {
  const std::uint32_t bracket = on_side(tree_[index], side);
  std::uint32_t* cells = brackets_[bracket].cells;
  const bool first_is_dead = cells[0] == 0 || tree_[cells[0] - 1].kind == CellKind::split;
  cells[first_is_dead ? 0 : 1] = index + 1;
  return bracket;
}

std::uint32_t BracketStore::on_side(const Cell& cell, int side_index) {
  const Lattice& lattice = tree_.lattice();
  const std::int32_t side = Lattice::side(cell.level);
  const bool vertical = side_index % 2 == 1;
  const std::int32_t x = cell.x + (side_index == 1 ? side : 0), y = cell.y + (side_index == 2 ? side : 0);
  const std::uint32_t fresh = static_cast<std::uint32_t>(brackets_.size());
  std::uint32_t& root = root_brackets_[cell.level == 0 ? root_edge(x, y, vertical) : 0];
  if (cell.level == 0) {
    if (root != FlatMap::kAbsent) return root;
    root = fresh;
  } else {
    const std::uint32_t index = index_.find_or_insert(Lattice::edge_key(x, y, vertical, cell.level), fresh);
    if (index != fresh) return index;
  }

  Bracket& b = brackets_.emplace_back();
  b.x = x;
  b.y = y;
  b.start = {lattice.x_px(x), lattice.y_px(y)};
  b.vertical = vertical;
  b.level = cell.level;
  b.pixel = cell.pixel;
  b.length_px = lattice.side_px(cell.level);
  // Sides 2 and 3 start at the corner where going round ends.
  b.first = cell.corner[side_index < 2 ? side_index : (side_index + 1) % 4];
  b.last = cell.corner[side_index < 2 ? side_index + 1 : side_index];
  const std::uint64_t key = hash(seed_, lattice.image_x(x), lattice.image_y(y), vertical, cell.level);
  const double contrast = contrast_(cell.pixel, b.first, b.last);
  const double tolerable =
      kFirstWidth * pixels_.allowed_deviation(cell.pixel) / (contrast * b.length_px + 1e-300);
  b.lay_grid(std::max(initial_px_, std::min(tolerable, b.length_px)), dither_.phase(key));
  inherit(b);
  return fresh;
}

/// A crossing located on a longer edge that this one is part of need not be searched again.
void BracketStore::inherit(Bracket& b) const {
  for (int level = b.level - 1; level >= 0; --level) {
    const std::int32_t longer = Lattice::side(level), mask = ~(longer - 1);
    if ((b.vertical ? b.x : b.y) & ~mask) continue;
    const std::int32_t px = b.vertical ? b.x : b.x & mask, py = b.vertical ? b.y & mask : b.y;
    const std::uint32_t parent = find(px, py, b.vertical, level);
    if (parent == FlatMap::kAbsent) continue;
    const Bracket& whole = brackets_[parent];
    const double offset = ((b.vertical ? b.y - py : b.x - px)) * tree_.lattice().unit_px();
    if (!whole.third_label && !whole.on_grid() && whole.first == b.first && whole.last == b.last &&
        whole.high > offset && whole.low < offset + b.length_px)
      b.inherit(whole, offset);
    break;
  }
}

std::uint32_t BracketStore::find(std::int32_t x, std::int32_t y, bool vertical, int level) const {
  if (level > 0) return index_.find(Lattice::edge_key(x, y, vertical, level));
  const bool inside = x <= tree_.lattice().width() && y <= tree_.lattice().height();
  return inside ? root_brackets_[root_edge(x, y, vertical)] : FlatMap::kAbsent;
}

const std::vector<std::uint32_t>& BracketStore::look_into(const std::vector<std::uint32_t>& brackets) {
  std::vector<FocalPoint>& points = queries_.points();
  points.resize(brackets.size());
  for (std::size_t i = 0; i < brackets.size(); ++i) points[i] = brackets_[brackets[i]].next_point();
  return queries_.ask();
}

/// In a narrow feature, told by vertices alone: where the border is seen to be must not decide how well it is known.
bool BracketStore::too_wide_in_narrow(const Bracket& b) const {
  if (b.width() <= kThinShare * b.length_px) return false;
  if (b.width() * b.length_px * contrast_(b.pixel, b.first, b.last) <
      kWorth * pixels_.allowed_deviation(b.pixel))
    return false;
  for (const std::int32_t step : {-Lattice::side(b.level), Lattice::side(b.level)}) {
    const std::int32_t x = b.vertical ? b.x : b.x + step, y = b.vertical ? b.y + step : b.y;
    if (x >= 0 && y >= 0 && find(x, y, b.vertical, b.level) != FlatMap::kAbsent) return true;
  }
  return false;
}

void BracketStore::locate(std::size_t first) {
  active_.resize(brackets_.size() - first);
  std::iota(active_.begin(), active_.end(), static_cast<std::uint32_t>(first));
  for (;;) {
    std::size_t kept = 0;
    for (std::uint32_t b : active_)
      if (!brackets_[b].third_label && (brackets_[b].on_grid() || too_wide_in_narrow(brackets_[b])))
        active_[kept++] = b;
    active_.resize(kept);
    if (active_.empty()) return;
    std::erase_if(active_, [&](std::uint32_t b) {
      while (too_wide_in_narrow(brackets_[b]) && brackets_[b].skip_known()) {
      }
      return !brackets_[b].on_grid() && !too_wide_in_narrow(brackets_[b]);
    });
    if (active_.empty()) return;
    const std::vector<std::uint32_t>& seen = look_into(active_);
    for (std::size_t i = 0; i < active_.size(); ++i) brackets_[active_[i]].take(seen[i]);
  }
}

}  // namespace ifov::sampling
