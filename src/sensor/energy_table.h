#pragma once

#include <cstddef>
#include <vector>

namespace ifov::sensor {

/// Energy of a density that is constant over the cells of a grid, as a function of the rectangle it falls on.
class EnergyTable {
 public:
  /// columns x rows cell energies, row by row, y downwards, over the rectangle centred on 0 with square cells
  /// of side `cell_px`. Normalised to a sum of 1. ifov::InputError on sums that are not positive.
  EnergyTable(int columns, int rows, double cell_px, const std::vector<double>& energy);

  double half_width_px() const { return 0.5 * cell_px_ * (columns_ > rows_ ? columns_ : rows_); }
  double within(double x0_px, double y0_px, double x1_px, double y1_px) const;

 private:
  double below(double x_px, double y_px) const;

  int columns_, rows_;
  double cell_px_;
  std::vector<double> summed_;  // (columns + 1) x (rows + 1)
};

}  // namespace ifov::sensor
