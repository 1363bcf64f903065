#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ifov::sampling {

class BorderModel;
class CellTree;
class Contrast;
class CrossingPrecision;
class EdgeCells;
class JunctionPredictor;
class TracedPixels;
struct OpenBorders;

/// Shares the variance that a pixel may keep between what no model follows, crossings, and middles of curves with
/// junctions. No decision depends on an observed error.
class Sharpener {
 public:
  Sharpener(CellTree& tree, BorderModel& model, EdgeCells& edge_cells, CrossingPrecision& crossings,
            const JunctionPredictor& junctions, const Contrast& contrast, TracedPixels& pixels)
      : tree_(tree),
        model_(model),
        edge_cells_(edge_cells),
        crossings_(crossings),
        junctions_(junctions),
        contrast_(contrast),
        pixels_(pixels) {}

  /// Makes crossings precise enough for every pixel's allowed variance, sets how precisely the middles of
  /// curves must be verified, and splits what spoils the variance without being a curve. Pixels in which
  /// nothing changed since are left out. Adds to `open` what has to be verified again.
  void sharpen(OpenBorders& open);

 private:
  struct MiddleTerm {
    std::uint32_t pixel, cell;
    double gain;  ///< variance per px^2 of the middle's width
  };
  struct LooseTerm {
    std::uint32_t cell;
    double variance;
    bool coherent;  ///< errs like the others of the pixel
  };
  void sharpen_pixel(std::uint32_t pixel);
  bool collect_terms(std::uint32_t pixel, std::uint32_t cell);
  void collect_curve(std::uint32_t pixel, std::uint32_t cell);
  void collect_junction(std::uint32_t cell);
  double split_largest_loose(std::uint32_t pixel);
  void share_middles(std::size_t first, std::size_t last, OpenBorders& open);

  CellTree& tree_;
  BorderModel& model_;
  EdgeCells& edge_cells_;
  CrossingPrecision& crossings_;
  const JunctionPredictor& junctions_;
  const Contrast& contrast_;
  TracedPixels& pixels_;
  std::vector<std::uint8_t> due_;    // the pixels that are being sharpened
  std::vector<MiddleTerm> middles_;  // of all of these, one pixel after the other
  std::vector<LooseTerm> loose_;     // of the pixel at hand
};

}  // namespace ifov::sampling
