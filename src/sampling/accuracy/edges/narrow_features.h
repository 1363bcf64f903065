#pragma once

#include <cstdint>

namespace ifov::sampling {

class BracketStore;
class CellTree;
class Contrast;
class TracedPixels;
struct Cell;

/// Features that end within a cell's side on both sides of a corner, as labels of vertices and crossings show them. Cells
/// along such a feature err alike. Labels that look alike in the pixel are one feature.
class NarrowFeatures {
 public:
  NarrowFeatures(const CellTree& tree, const BracketStore& brackets, const Contrast& contrast,
                 const TracedPixels& pixels)
      : tree_(tree), brackets_(brackets), contrast_(contrast), pixels_(pixels) {}

  /// Whether some corner of the cell lies in such a feature, along a lattice line.
  bool has_corner_of(const Cell& cell) const;

  /// Width, px, of the narrowest feature that a corner of the cell lies in, along a lattice line; infinite where none ends on
  /// both sides before the next vertices.
  double width_at(const Cell& cell) const;

  /// Width of the narrowest one that one of the pixel's vertices on the lattice lies in; infinite where none is narrower
  /// than the lattice is fine. Such a feature was met by chance. Where it ends beside the vertex and the next vertex the
  /// other way lies where it is wide, it is the rim of something wide.
  double narrowest_met(std::uint32_t pixel) const;

 private:
  struct Place {
    std::uint32_t pixel = 0, label = 0;
    std::int32_t x = 0, y = 0;
    int level = 0;
  };
  Place corner_of(const Cell& cell, int corner) const;
  double reach(const Place& place, bool vertical, bool forward) const;
  double width_across(const Place& place, bool vertical) const;
  bool is_rim(const Place& vertex, bool vertical, double width_px) const;
  bool look_alike(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const;

  const CellTree& tree_;
  const BracketStore& brackets_;
  const Contrast& contrast_;
  const TracedPixels& pixels_;
};

}  // namespace ifov::sampling
