#pragma once

#include <vector>

#include "sampling/field.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_footprint.h"
#include "sampling/pixel_rect.h"
#include "sampling/random.h"

namespace ifov::sampling {

/// The focal plane divided into equal sub-elements, columns x rows of them per pixel, numbered through the
/// image: sub-element (c, r) belongs to pixel (floor(c / columns), floor(r / rows)). Under a box footprint of
/// side 1 or less they tile the sensitive square of each pixel; under a wider footprint they tile whole
/// pixels and are shared by all the pixels whose footprint they lie in.
class SubElementLattice {
 public:
  /// Weights are of one group of columns, for pixels in a column of the image; the sub-elements are the same for all, as far as any
  /// of them reaches.
  SubElementLattice(const ColumnFootprints& footprints, std::size_t group, int at, int columns_per_pixel,
                    int rows_per_pixel);

  int columns_per_pixel() const { return columns_; }
  int rows_per_pixel() const { return rows_; }

  /// The point at `within` ([0, 1)^2, y downwards) of sub-element (column, row).
  FocalPoint at(int column, int row, Point2 within) const;
  /// The same of sub-element (a, b) of pixel (i, j).
  FocalPoint at(int i, int j, int a, int b, Point2 within) const;

  /// Pixel (i, j) is the sum of weight(a, b) times sub-element (i columns + first_column + a, j rows +
  /// first_row + b) for a < width, b < height. Weights add up to 1.
  int first_column() const { return first_column_; }
  int first_row() const { return first_row_; }
  int width() const { return width_; }
  int height() const { return height_; }
  double weight(int a, int b) const { return weights_[static_cast<std::size_t>(b * width_ + a)]; }

 private:
  int columns_, rows_;
  double side_ = 1.0;  // of the square that the sub-elements of one pixel tile, px
  int first_column_ = 0, first_row_ = 0, width_, height_;
  std::vector<double> weights_;
};

/// The lattices of groups of columns for pixels in columns of the image.
class SubElementLattices {
 public:
  SubElementLattices(const ColumnFootprints& footprints, PixelRect tile, int columns_per_pixel,
                     int rows_per_pixel);
  std::size_t groups() const { return groups_; }
  /// The sub-elements are the same in all.
  const SubElementLattice& any() const { return all_.front(); }
  const SubElementLattice& of(std::size_t group, int column) const {
    const int at = by_column_ ? column - first_column_ : 0;
    return all_[static_cast<std::size_t>(at) * groups_ + group];
  }

 private:
  std::size_t groups_;
  int first_column_;
  bool by_column_;
  std::vector<SubElementLattice> all_;  // [column][group], of one column where all are alike
};

/// The point of a footprint's distribution about the pixel's centre, px, that a point of the unit square stands for: the first number
/// inverts the marginal in x, the second the share of a narrow strip there. Equal cells of the square become parts of equal weight.
Point2 footprint_point(const PixelFootprint& footprint, Point2 u);

constexpr int floor_divide(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

}  // namespace ifov::sampling
