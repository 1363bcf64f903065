#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sampling/accuracy/weights/clutter_round.h"

namespace ifov::sampling {

/// The kept values of a round of clutter, laid out to be weighed by one footprint after the other: what moments need of values
/// alone is there once, and all that is left are sums over rows.
class ClutterGrid {
 public:
  /// Values of these columns.
  ClutterGrid(const ClutterRound& round, std::span<const int> columns);

  /// Weighs the values by a footprint; false where none lies under it.
  bool weigh(const PixelFootprint& footprint, Point2 centre);
  /// Of the column at this position, as they were weighed last: what ClutterRound::moment() says but for rounding.
  ClutterRound::Moment moment(std::size_t position) const;

 private:
  struct Column {
    std::vector<double> value;  // row by row of cells
    std::vector<double>
        across;  // of neighbours in a row, what they add to a border's variance; the row's last is nil
    std::vector<double> down;   // the same of neighbours in a column of cells; none below the last row
    std::vector<double> twist;  // by block: square of what no plane explains
  };

  std::size_t across_;  // cells in a row
  std::vector<double> x_, y_, weight_;
  std::vector<double> block_squares_;  // by block: sum of the weights' squares
  double total_ = 0.0;
  std::vector<Column> columns_;
};

}  // namespace ifov::sampling
