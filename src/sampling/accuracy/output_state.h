#pragma once

#include "sampling/accuracy/basis/small_vector.h"
#include "sampling/accuracy/basis/stopping.h"

namespace ifov::sampling {

/// How far an output pixel of a tile has come.
struct OutputState {
  int test = 0;  ///< those of an earlier run included
  int last_test = Stopping::kTests;
  bool satisfied = false;
  /// Per steering column: variance that paths may leave, and how many times the values there are it asks for.
  SmallVector<double, 2> path_budget, growth;
};

}  // namespace ifov::sampling
