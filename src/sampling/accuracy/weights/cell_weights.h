#pragma once

#include <cstddef>
#include <vector>

namespace ifov::sampling {

class ColumnFootprints;

/// Integrals of the footprints of groups over pixels and over the lattice's first cells, by where these lie from the output's
/// pixel: the same for all outputs of a tile, where the footprints lie alike in all columns of the image.
class CellWeights {
 public:
  CellWeights(const ColumnFootprints& footprints, int cells_per_pixel);

  /// Of the pixel that stands so many pixels from the output's.
  double of_pixel(std::size_t group, int dx, int dy) const {
    return pixels_[at(group, dx + reach_, dy + reach_, 2 * reach_ + 1)];
  }
  /// Of the cell in this column and row, counted from the first of the output's pixel.
  double of_cell(std::size_t group, int column, int row) const {
    return cells_[at(group, column + reach_ * cells_per_pixel_, row + reach_ * cells_per_pixel_,
                     (2 * reach_ + 1) * cells_per_pixel_)];
  }

 private:
  static std::size_t at(std::size_t group, int i, int j, int side) {
    return (group * static_cast<std::size_t>(side) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(side) +
           static_cast<std::size_t>(i);
  }

  int reach_, cells_per_pixel_;
  std::vector<double> pixels_, cells_;  // [group][row][column]
};

}  // namespace ifov::sampling
