#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/accuracy/basis/flat_map.h"
#include "sampling/accuracy/borders/bracket.h"

namespace ifov::sampling {

class CellTree;
class Contrast;
class Dither;
class PointQueries;
class TracedPixels;
struct Cell;

/// The crossings of borders with sides of cells, each known to a bracket. Neighbours share them.
class BracketStore {
 public:
  /// `initial_px`: least width to which a crossing is located at first.
  BracketStore(const CellTree& tree, const Contrast& contrast, const TracedPixels& pixels,
               PointQueries& queries, const Dither& dither, double initial_px, std::uint64_t seed)
      : tree_(tree),
        contrast_(contrast),
        pixels_(pixels),
        queries_(queries),
        dither_(dither),
        initial_px_(initial_px),
        seed_(seed) {}

  /// Once the tree has its first cells; `expected` brackets.
  void plant(std::size_t expected);

  Bracket& operator[](std::uint32_t bracket) { return brackets_[bracket]; }
  const Bracket& operator[](std::uint32_t bracket) const { return brackets_[bracket]; }
  std::size_t size() const { return brackets_.size(); }

  /// The bracket on a side of cell number `index`, whose ends have unlike labels: known already, or new. A border that
  /// crosses it goes on in the cell.
  std::uint32_t enter(std::uint32_t index, int side);
  /// FlatMap::kAbsent where there is none.
  std::uint32_t find(std::int32_t x, std::int32_t y, bool vertical, int level) const;

  /// Locates the crossings from number `first` on as well as the tolerance asks at first.
  void locate(std::size_t first);
  /// One ray at the next point of each of these brackets: what is seen there, in order.
  const std::vector<std::uint32_t>& look_into(const std::vector<std::uint32_t>& brackets);

  /// Where a border that ends in the bracket is drawn.
  Point2 end_point(std::uint32_t bracket) const {
    const Bracket& b = brackets_[bracket];
    return b.at(b.centre());
  }
  /// The middle of a bracket, wherever it is: what end_point draws is never beyond the side, and errs inwards beside its end.
  Point2 middle_point(std::uint32_t bracket) const {
    const Bracket& b = brackets_[bracket];
    return b.at(0.5 * (b.low + b.high));
  }

 private:
  std::uint32_t on_side(const Cell& cell, int side);
  void inherit(Bracket& bracket) const;
  bool too_wide_in_narrow(const Bracket& bracket) const;
  std::size_t root_edge(std::int32_t x, std::int32_t y, bool vertical) const;

  const CellTree& tree_;
  const Contrast& contrast_;
  const TracedPixels& pixels_;
  PointQueries& queries_;
  const Dither& dither_;
  double initial_px_;
  std::uint64_t seed_;
  std::vector<Bracket> brackets_;
  std::vector<std::uint32_t> root_brackets_;  // on sides of the lattice, by root_edge
  FlatMap index_;                             // on others
  std::vector<std::uint32_t> active_;         // kept for its memory
};

}  // namespace ifov::sampling
