#pragma once

#include <cstdint>
#include <vector>

#include "sampling/accuracy/edges/curve_check.h"

namespace ifov::sampling {

class BorderModel;
class CellTree;
class Contrast;
class CurvePredictor;
class NarrowFeatures;
class PointQueries;
class TracedPixels;

/// Looks whether curves run where they are predicted, all of them at once, a batch of rays a stage. What is seen to run
/// elsewhere is searched for, tried as a corner, split in the end.
class CurveVerifier {
 public:
  CurveVerifier(CellTree& tree, BorderModel& model, const CurvePredictor& predictor,
                const NarrowFeatures& features, const Contrast& contrast, TracedPixels& pixels,
                PointQueries& queries)
      : tree_(tree),
        model_(model),
        predictor_(predictor),
        features_(features),
        contrast_(contrast),
        pixels_(pixels),
        queries_(queries) {}

  /// Those of these cells that are tentative; leaves none of them.
  void verify(std::vector<std::uint32_t>& cells);

 private:
  void begin(CurveCheck& check);
  void weigh_answers(CurveCheck& check, const std::uint32_t* seen);
  void follow(CurveCheck& check);
  void follow_arc(CurveCheck& check);
  void refuse(CurveCheck& check);
  void accept(CurveCheck& check);
  bool may_leave_pixel(const CurveCheck& check, std::uint32_t pixel) const;

  CellTree& tree_;
  BorderModel& model_;
  const CurvePredictor& predictor_;
  const NarrowFeatures& features_;
  const Contrast& contrast_;
  TracedPixels& pixels_;
  PointQueries& queries_;
  std::vector<CurveCheck> checks_;
  std::vector<std::uint32_t> active_;  // of the checks
};

}  // namespace ifov::sampling
