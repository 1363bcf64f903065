#pragma once

#include <cstdint>

namespace ifov::sampling {

class BracketStore;
class CellTree;
struct Cell;

/// Features that end within a cell's side on both sides of a corner, as labels of vertices and crossings show them. Cells
/// along such a feature err alike.
class NarrowFeatures {
 public:
  NarrowFeatures(const CellTree& tree, const BracketStore& brackets) : tree_(tree), brackets_(brackets) {}

  /// Whether some corner of the cell lies in such a feature, along a lattice line.
  bool has_corner_of(const Cell& cell) const;

  /// Width, px, of the narrowest feature that a corner of the cell lies in, along a lattice line; infinite where none ends on
  /// both sides before the next vertices.
  double width_at(const Cell& cell) const;

  /// Width of the narrowest one that one of the pixel's vertices on the lattice lies in; infinite where none is narrower
  /// than the lattice is fine. Such a feature was met by chance.
  double narrowest_met(std::uint32_t pixel) const;

 private:
  double reach(const Cell& cell, int corner, bool vertical, bool forward) const;

  const CellTree& tree_;
  const BracketStore& brackets_;
};

}  // namespace ifov::sampling
