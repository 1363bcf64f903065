#include <algorithm>
#include <cmath>

#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// First width of a bracket, in units of what the tolerance allows to a crossing of one side of its cell.
constexpr double kFirstWidth = 0.3;
/// Where a lattice line is crossed on both sides of a vertex, in a narrow feature, both brackets are refined to this share of
/// their side, as long as a bracket out of place would cost kWorth of the allowed standard error.
constexpr double kThinShare = 0.125, kWorth = 0.5;

}  // namespace

std::uint32_t EdgeTracer::bracket_on(const Cell& cell, int side_index) {
  const std::int32_t side = Lattice::side(cell.level);
  const bool vertical = side_index % 2 == 1;
  const std::int32_t x = cell.x + (side_index == 1 ? side : 0), y = cell.y + (side_index == 2 ? side : 0);
  const std::uint32_t fresh = static_cast<std::uint32_t>(brackets_.size());
  std::uint32_t& root = root_brackets_[cell.level == 0 ? root_edge(x, y, vertical) : 0];
  if (cell.level == 0) {
    if (root != FlatMap::kAbsent) return root;
    root = fresh;
  } else {
    const std::uint32_t index =
        bracket_index_.find_or_insert(Lattice::edge_key(x, y, vertical, cell.level), fresh);
    if (index != fresh) return index;
  }

  Bracket& b = brackets_.emplace_back();
  b.x = x;
  b.y = y;
  b.start = {lattice_.x_px(x), lattice_.y_px(y)};
  b.vertical = vertical;
  b.level = cell.level;
  b.pixel = cell.pixel;
  b.length_px = lattice_.side_px(cell.level);
  // Sides 2 and 3 start at the corner where going round ends.
  b.first = cell.corner[side_index < 2 ? side_index : (side_index + 1) % 4];
  b.last = cell.corner[side_index < 2 ? side_index + 1 : side_index];
  const std::uint64_t key = hash(seed_, lattice_.image_x(x), lattice_.image_y(y), vertical, cell.level);
  const double contrast = contrast_(cell.pixel, b.first, b.last);
  const double tolerable =
      kFirstWidth * std::sqrt(allowed_variance_[cell.pixel]) / (contrast * b.length_px + 1e-300);
  b.lay_grid(std::max(options_.initial_bracket_px, std::min(tolerable, b.length_px)), key,
             !faults_.undithered_brackets);

  // A crossing located on a longer edge that this one is part of need not be searched again.
  for (int level = cell.level - 1; level >= 0; --level) {
    const std::int32_t longer = Lattice::side(level), mask = ~(longer - 1);
    if ((vertical ? x : y) & ~mask) continue;
    const std::int32_t px = vertical ? x : x & mask, py = vertical ? y & mask : y;
    const std::uint32_t parent = known_bracket(px, py, vertical, level);
    if (parent == FlatMap::kAbsent) continue;
    const Bracket& whole = brackets_[parent];
    const double offset = ((vertical ? y - py : x - px)) * lattice_.unit_px();
    if (!whole.third_label && !whole.on_grid() && whole.first == b.first && whole.last == b.last &&
        whole.high > offset && whole.low < offset + b.length_px)
      b.inherit(whole, offset);
    break;
  }
  return fresh;
}

std::uint32_t EdgeTracer::known_bracket(std::int32_t x, std::int32_t y, bool vertical, int level) const {
  if (level > 0) return bracket_index_.find(Lattice::edge_key(x, y, vertical, level));
  const bool inside = x <= lattice_.width() && y <= lattice_.height();
  return inside ? root_brackets_[root_edge(x, y, vertical)] : FlatMap::kAbsent;
}

/// One ray at the next point of every active bracket.
void EdgeTracer::look_into_brackets() {
  points_.resize(active_.size());
  for (std::size_t i = 0; i < active_.size(); ++i) points_[i] = brackets_[active_[i]].next_point();
  ask(seen_);
}

void EdgeTracer::locate() {
  // By vertices alone: where the border is seen to be must not decide how well it is known.
  const auto narrow = [&](const Bracket& b) {
    if (b.width() <= kThinShare * b.length_px) return false;
    if (b.width() * b.length_px * contrast_(b.pixel, b.first, b.last) <
        kWorth * std::sqrt(allowed_variance_[b.pixel]))
      return false;
    for (const std::int32_t step : {-Lattice::side(b.level), Lattice::side(b.level)}) {
      const std::int32_t x = b.vertical ? b.x : b.x + step, y = b.vertical ? b.y + step : b.y;
      if (x >= 0 && y >= 0 && known_bracket(x, y, b.vertical, b.level) != FlatMap::kAbsent) return true;
    }
    return false;
  };
  for (;;) {
    std::size_t kept = 0;
    for (std::uint32_t b : active_)
      if (!brackets_[b].third_label && (brackets_[b].on_grid() || narrow(brackets_[b]))) active_[kept++] = b;
    active_.resize(kept);
    if (active_.empty()) return;
    std::erase_if(active_, [&](std::uint32_t b) {
      while (narrow(brackets_[b]) && brackets_[b].skip_known()) {
      }
      return !brackets_[b].on_grid() && !narrow(brackets_[b]);
    });
    if (active_.empty()) return;
    look_into_brackets();
    for (std::size_t i = 0; i < active_.size(); ++i) brackets_[active_[i]].take(seen_[i]);
  }
}

}  // namespace ifov::sampling
