#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ifov::io {

/// Where the middles of an image's pixels lie on the map, m, line by line; not numbers where they lie nowhere.
struct PixelPlaces {
  int width = 0, height = 0;
  std::vector<double> x_m, y_m;

  std::size_t at(int column, int line) const {
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// Which pixel of the image is to be shown in each cell of a grid that is level with the map: ENVI's geographic lookup table
/// (GLT). Columns and lines count from 1. Negative: no pixel's middle lies in the cell, and it has the nearest of the four neighbouring
/// ones between whose middles it lies. 0: it lies between none.
struct LookupTable {
  int width = 0, height = 0;
  double left_m = 0.0, top_m = 0.0, cell_m = 0.0;  ///< the outer corner of the upper left cell
  std::vector<std::int32_t> sample, line;
  std::size_t pixels_without_place = 0;
};

/// Of at most so many cells a pixel of the image: of images that reach to the horizon cells are larger.
inline constexpr int kMostCellsPerPixel = 8;

/// Cells are as large as the typical pixel (the geometric mean of the medians of distances along lines and along columns), to
/// two digits, and begin at multiples of that. No cells where no pixel has a place.
LookupTable make_lookup_table(const PixelPlaces& places);

}  // namespace ifov::io
