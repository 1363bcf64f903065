#pragma once

#include <cstdint>

namespace ifov::sampling {

class CellTree;
class Contrast;
class NarrowFeatures;
class TracedPixels;

/// Cells that hold more than one border, and no junction: counted by their corners where that errs little, split elsewhere.
class ComplexCells {
 public:
  /// `thinnest_px`: features of this width are still followed.
  ComplexCells(CellTree& tree, const NarrowFeatures& features, const Contrast& contrast, TracedPixels& pixels,
               double thinnest_px)
      : tree_(tree), features_(features), contrast_(contrast), pixels_(pixels), thinnest_px_(thinnest_px) {}

  void settle(std::uint32_t cell);

 private:
  CellTree& tree_;
  const NarrowFeatures& features_;
  const Contrast& contrast_;
  TracedPixels& pixels_;
  double thinnest_px_;
};

}  // namespace ifov::sampling
