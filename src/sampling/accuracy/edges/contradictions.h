#pragma once

#include <cstdint>

#include "sampling/field.h"

namespace ifov::sampling {

class BorderModel;
class Contrast;
class TracedPixels;
struct Cell;

/// What labels seen at points say against the traced model.
class Contradictions {
 public:
  Contradictions(const BorderModel& model, const Contrast& contrast, const TracedPixels& pixels)
      : model_(model), contrast_(contrast), pixels_(pixels) {}

  /// Whether what was seen at a point contradicts the model, where its curves may be off by the width to
  /// which they are known and `slack_px` more.
  bool disagrees(FocalPoint point, std::uint32_t label, double slack_px) const;

  /// Whether a strip of one label on the other, as wide as the lattice is fine, would matter in the pixel.
  bool matters(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const;
  /// Width in px of a tip of one label in the other, as long as it is wide, of which half an allowed standard error would come.
  double tip_that_matters(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const;

  /// Contrast of what was seen at a point to the model, where the two differ in a cell that is too small to be refined;
  /// 0 where they agree or a border's own uncertainty explains it.
  double dismissed(FocalPoint point, std::uint32_t label) const;

 private:
  bool foreign(const Cell& cell, std::uint32_t label) const;
  bool within_tolerance(const Cell& cell, FocalPoint point, std::uint32_t model, std::uint32_t seen,
                        double slack_px) const;
  bool beside_border(const Cell& cell, FocalPoint point, std::uint32_t seen, double slack_px) const;
  bool under_arc_beside(const Cell& cell, FocalPoint point, std::uint32_t seen, double slack_px) const;
  bool under_arc(const Cell& cell, FocalPoint point, std::uint32_t seen, double slack_px) const;
  bool beside_legs(const Cell& cell, FocalPoint point, std::uint32_t seen, double slack_px) const;

  const BorderModel& model_;
  const Contrast& contrast_;
  const TracedPixels& pixels_;
};

}  // namespace ifov::sampling
