#pragma once

#include <cstdint>
#include <vector>

#include "sampling/accuracy/edges/junction_check.h"

namespace ifov::sampling {

class BorderModel;
class CellTree;
class ComplexCells;
class JunctionPredictor;
class PointQueries;
class TracedPixels;

/// Looks where borders meet in the cells in which three labels do, all of them at once, a batch of rays a stage.
class JunctionVerifier {
 public:
  JunctionVerifier(const CellTree& tree, BorderModel& model, const JunctionPredictor& predictor,
                   ComplexCells& complex, TracedPixels& pixels, PointQueries& queries)
      : tree_(tree),
        model_(model),
        predictor_(predictor),
        complex_(complex),
        pixels_(pixels),
        queries_(queries) {}

  /// Those of these cells that have a junction; leaves none of them.
  void verify(std::vector<std::uint32_t>& cells);

 private:
  void weigh_answers(JunctionCheck& check, const std::uint32_t* seen);
  void check_legs(JunctionCheck& check);
  void refuse(JunctionCheck& check);
  void accept(JunctionCheck& check);

  const CellTree& tree_;
  BorderModel& model_;
  const JunctionPredictor& predictor_;
  ComplexCells& complex_;
  TracedPixels& pixels_;
  PointQueries& queries_;
  std::vector<JunctionCheck> checks_;
  std::vector<std::uint32_t> active_;  // of the checks
};

}  // namespace ifov::sampling
