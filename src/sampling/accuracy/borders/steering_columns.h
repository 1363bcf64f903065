#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ifov::sampling {

class Contrast;

/// The columns by which borders are traced and values are planned. A problem names some that stand for all; where two
/// labels of a tile differ much more in another one, it steers as well.
class SteeringColumns {
 public:
  SteeringColumns(std::span<const int> given, std::size_t columns)
      : list_(given.begin(), given.end()), columns_(columns) {}

  const std::vector<int>& list() const { return list_; }
  bool all() const { return list_.size() >= columns_; }

  /// Lets the column steer in which labels `a` and `b` differ most, if those that steer do not tell them apart nearly as
  /// well; `inverse_square`: 1 over the square of the standard error allowed to a pixel, by column.
  void cover(const Contrast& contrast, std::uint32_t a, std::uint32_t b,
             std::span<const double> inverse_square);
  /// Lets this column steer.
  void let_steer(int column);

 private:
  std::vector<int> list_;
  std::size_t columns_;
};

}  // namespace ifov::sampling
