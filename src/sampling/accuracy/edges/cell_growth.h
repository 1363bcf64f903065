#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ifov::sampling {

class BorderModel;
class BracketStore;
class CellTree;
class ComplexCells;
class Contrast;
class EdgeCells;
class NarrowFeatures;
class TracedPixels;
struct OpenBorders;

/// Grows the tree, level by level: what each new cell holds is read off its corners, crossings are located, and borders are
/// put through them, which still have to be verified.
class CellGrowth {
 public:
  CellGrowth(CellTree& tree, BracketStore& brackets, BorderModel& model, EdgeCells& edge_cells,
             ComplexCells& complex, const NarrowFeatures& features, const Contrast& contrast,
             TracedPixels& pixels)
      : tree_(tree),
        brackets_(brackets),
        model_(model),
        edge_cells_(edge_cells),
        complex_(complex),
        features_(features),
        contrast_(contrast),
        pixels_(pixels) {}

  /// One level of the fresh cells, whose corners are known. Adds the borders put through them to `open`.
  void grow(OpenBorders& open);

 private:
  void classify(std::uint32_t cell);
  void put_curve(std::uint32_t cell, const int crossed[2]);
  void put_junction(std::uint32_t cell, const int crossed[3]);
  bool met_third_label(std::span<const std::uint32_t> brackets) const;

  CellTree& tree_;
  BracketStore& brackets_;
  BorderModel& model_;
  EdgeCells& edge_cells_;
  ComplexCells& complex_;
  const NarrowFeatures& features_;
  const Contrast& contrast_;
  TracedPixels& pixels_;
  std::vector<std::uint32_t> level_,
      awaiting_;  // cells: of the level; those whose crossings are being located
};

}  // namespace ifov::sampling
