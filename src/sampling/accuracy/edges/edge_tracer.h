#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/ray_ledger.h"

namespace ifov::sampling {

class BorderModel;
class CellTree;
class Contradictions;
class Contrast;
class Dither;
class EdgeCells;
class TracedPixels;
struct AccuracyOptions;

/// Traces the borders between labels over a tile's lattice: a quadtree of cells whose leaves are uniform,
/// crossed by one verified curve, or too small to matter. Works level by level: all points of a stage are one
/// batch. It holds the parts that do so and says whose turn it is. docs/theory/accuracy_sampler.md, sections 2 to 4.
class EdgeTracer {
 public:
  EdgeTracer(const Lattice& lattice, RayLedger& ledger, LabelTable& table, Contrast& contrast,
             const AccuracyOptions& options, const Dither& dither, std::uint64_t seed);
  ~EdgeTracer();

  /// Makes the first cells from the labels of the lattice's vertices, row by row.
  void plant(std::span<const std::uint32_t> vertex_labels);

  /// Traces until every leaf is verified and every pixel's variance is as small as it may be.
  void settle();

  /// Marks the leaf at a point to be split where the model contradicts what was seen there; false where it
  /// agrees or cannot be refined further. The next settle() does the work.
  bool contradict(FocalPoint point, std::uint32_t label);

  /// Labels of further points, for pilot rays and probes.
  void ask_at(const std::vector<FocalPoint>& points, std::vector<std::uint32_t>& labels, Purpose purpose);

  /// About how wide the narrowest feature is that was followed into the pixel across the sides of its cells; infinite: none.
  double narrowest_followed(std::uint32_t pixel) const;
  /// Width of the narrowest feature that one of the pixel's vertices on the lattice lies in; infinite where none is
  /// narrower than the lattice is fine. Such a feature was met by chance.
  double narrowest_met(std::uint32_t pixel) const;
  bool may_have_corners(std::uint32_t a, std::uint32_t b) const;  ///< Field::may_have_corners
  /// Side of the smallest cell that holds the point: about the width of what was traced there.
  double leaf_side_px(FocalPoint point) const;

  const Lattice& lattice() const { return lattice_; }
  /// What may be spent on each pixel, and what was noticed there.
  TracedPixels& pixels();
  const TracedPixels& pixels() const;
  const CellTree& tree() const;
  const EdgeCells& edge_cells() const;
  const BorderModel& model() const;
  const Contradictions& contradictions() const;

 private:
  struct Parts;

  const Lattice& lattice_;
  RayLedger& ledger_;
  bool clutter_switch_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ifov::sampling
