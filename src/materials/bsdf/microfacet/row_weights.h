#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ifov::materials {

/// Rows first, first + 1, ... of a table, and their weights, which sum to 1.
struct RowWeights {
  std::size_t first;
  std::array<double, 4> weight;
};

/// The cubic through four of the points 0, 1, ..., count - 1, two on either side of `position` but at the ends.
inline RowWeights cubic_weights(double position, std::size_t count) {
  const double start = std::clamp(std::floor(position) - 1.0, 0.0, static_cast<double>(count - 4));
  const double s = position - start, a = s - 1.0, b = s - 2.0, c = s - 3.0;
  return {static_cast<std::size_t>(start),
          {-a * b * c / 6.0, 0.5 * s * b * c, -0.5 * s * a * c, s * a * b / 6.0}};
}

}  // namespace ifov::materials
