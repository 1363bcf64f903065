#pragma once

#include <cstdint>
#include <vector>

namespace ifov::sampling {

class BracketStore;
class CellTree;
class ComplexCells;
class TracedPixels;

/// Makes crossings as precise as pixels need them: brackets are halved where that helps most. Pixels are planned one after
/// the other, and all that is wanted is traced together.
class CrossingPrecision {
 public:
  CrossingPrecision(const CellTree& tree, BracketStore& brackets, ComplexCells& complex, TracedPixels& pixels)
      : tree_(tree), brackets_(brackets), complex_(complex), pixels_(pixels) {}

  void begin_pixel();
  /// What a crossing adds to the pixel's variance through one cell, per px^2 of its bracket's width.
  void add(std::uint32_t bracket, double gain);
  /// Plans to halve, again and again, the bracket that counts most, until all of a pixel's crossings together
  /// are within `target`.
  void want(double target);

  /// Traces what is wanted: one ray a round for every bracket that is to be halved. Cells in which a third label turns
  /// up have no border any more.
  void halve();

 private:
  struct Term {
    std::uint32_t bracket;
    double variance;  ///< at first per px^2 of the bracket's width, of both cells that share it
    std::uint8_t halvings = 0;
  };

  const CellTree& tree_;
  BracketStore& brackets_;
  ComplexCells& complex_;
  TracedPixels& pixels_;
  std::vector<Term> terms_;           // of the pixel
  std::vector<std::uint32_t> place_;  // by bracket: its place in terms_, if that is of the bracket
  std::vector<std::uint32_t> active_;
};

}  // namespace ifov::sampling
