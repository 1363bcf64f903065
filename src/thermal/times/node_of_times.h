#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <vector>

#include "thermal/times/classes_of_times.h"

namespace ifov::thermal {

/// Of a direction at a level of wind, by lane; in pairs: with the sky hidden, free.
struct NodeOfTimes {
  std::array<std::vector<float>, 2> shaded_k, ratio;
  /// By row and lane alpha E times the kernel of the span after a row, and of that before it. Behind the last row of a time nothing is;
  /// what the series says of it stands for the half step before it alone.
  std::array<std::vector<float>, 2> left, right;
  std::array<std::vector<float>, 2> moment;  ///< by bin, summed with the directions to the Sun: x, y, z
  std::array<std::vector<float>, 2> sum;     ///< without them
  std::vector<float> difference;             ///< the same of (1 + 2 c) (K_1 - K_0), mean of both skies
};

struct ClassesOfTimes::Place {
  std::once_flag once;
  std::atomic<bool> filled = false;
  NodeOfTimes node;
};

}  // namespace ifov::thermal
