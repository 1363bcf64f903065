#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sampling/field.h"
#include "sampling/random.h"

namespace ifov::sampling {

/// Where the labels change along one lattice edge: [low, high], in px from the edge's start, with label
/// `first` at low and `last` at high. The bracket starts on a grid of equal steps shifted by a hashed phase
/// (the dither), so that its centre errs uniformly within half a step and independently of every other edge, wherever
/// on the edge the crossing is: the grid goes on beyond the ends, whose labels are known. Later it is halved.
struct Bracket {
  std::int32_t x = 0, y = 0;  ///< the edge's start, fine units
  Point2 start;               ///< the same, image px
  bool vertical = false;
  std::uint8_t level = 0;
  std::uint32_t pixel = 0;   ///< of a cell beside it
  bool third_label = false;  ///< a label other than those of the two ends was met
  std::uint32_t first = 0, last = 0;
  double length_px = 0.0;
  double low = 0.0, high = 0.0;
  double phase = 1.0, step = 0.0;
  int grid_low = 0, grid_high = 1, grid_count = 1;
  std::uint32_t cells[2] = {0, 0};  ///< the cells whose chords end here (index + 1; 0: none)
  std::uint8_t halvings = 0;        ///< still wanted, while crossings are sharpened

  double width() const { return high - low; }
  /// Where the border is drawn.
  double centre() const { return std::clamp(0.5 * (low + high), 0.0, length_px); }
  /// How far the middle of the bracket lies beyond the edge's end, where the border is drawn. Near an end the middle of
  /// what a bracket has on the edge would err to one side; areas are taken as if the border were at its whole middle.
  double excess() const { return 0.5 * (low + high) - centre(); }
  bool on_grid() const { return grid_high - grid_low > 1; }

  /// Lays the grid: 2^n - 1 whole steps, about `target_px` wide, the first of which begins `grid_phase` - 1 steps from
  /// the edge's start (the dither, in [0, 1)).
  void lay_grid(double target_px, double grid_phase) {
    int bits = 0;
    const double mantissa = std::frexp(length_px / target_px + 1.0, &bits);
    if (mantissa < std::numbers::sqrt2 / 2.0) --bits;  // the nearest power of two
    grid_count = 1 << std::clamp(bits, 1, 20);
    phase = grid_phase;
    step = length_px / (grid_count - 1);
    grid_low = 0;
    grid_high = grid_count;
    low = grid_position(0);
    high = grid_position(grid_count);
  }

  /// The next point to look at, in px from the start.
  double next() const { return on_grid() ? grid_position((grid_low + grid_high) / 2) : 0.5 * (low + high); }

  /// Whether the next point lies beyond the edge, whose ends are known; if so it is taken as looked at.
  bool skip_known() {
    if (on_grid()) return false;
    const double middle = 0.5 * (low + high);
    if (middle > 0.0 && middle < length_px) return false;
    (middle <= 0.0 ? low : high) = middle;
    return true;
  }

  void take(std::uint32_t label) {
    const bool before = label == first;
    if (!before && label != last) {
      third_label = true;
      last = label;
    }
    if (on_grid()) {
      const int middle = (grid_low + grid_high) / 2;
      (before ? grid_low : grid_high) = middle;
      (before ? low : high) = grid_position(middle);
    } else {
      (before ? low : high) = 0.5 * (low + high);
    }
  }

  Point2 at(double t) const { return vertical ? Point2{start.x, start.y + t} : Point2{start.x + t, start.y}; }
  FocalPoint next_point() const {
    const Point2 p = at(next());
    return {p.x, p.y};
  }

  /// Takes over what is known about the whole edge whose half (starting at `offset_px`) this edge is.
  void inherit(const Bracket& parent, double offset_px) {
    low = parent.low - offset_px;
    high = parent.high - offset_px;
    grid_low = 0;
    grid_high = 1;
  }

 private:
  double grid_position(int j) const { return (j - 1 + phase) * step; }
};

}  // namespace ifov::sampling
