#pragma once

#include <cstdint>

namespace ifov::sampling {

class BracketStore;
class CellTree;
struct Cell;

/// Features no wider than two cells, as labels of vertices and crossings on both sides of one show them. Cells along such a
/// feature err alike.
class NarrowFeatures {
 public:
  NarrowFeatures(const CellTree& tree, const BracketStore& brackets) : tree_(tree), brackets_(brackets) {}

  /// Whether some corner of the cell lies in such a feature: the next vertices of the same spacing, on both sides along a
  /// lattice line, are known and unlike it.
  bool has_corner_of(const Cell& cell) const;

  /// Width, px, of the narrowest one that a corner of the cell lies in, by the crossings on both sides along a lattice
  /// line; infinite where there is none.
  double width_at(const Cell& cell) const;

  /// Width of the narrowest one that one of the pixel's vertices on the lattice lies in; infinite where none is narrower
  /// than the lattice is fine. Such a feature was met by chance.
  double narrowest_met(std::uint32_t pixel) const;

 private:
  bool unlike(const Cell& cell, int corner, std::int32_t x, std::int32_t y) const;

  const CellTree& tree_;
  const BracketStore& brackets_;
};

}  // namespace ifov::sampling
