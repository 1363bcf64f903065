#include "sampling/sub_element_lattice.h"

#include <algorithm>
#include <cmath>

namespace ifov::sampling {

SubElementLattice::SubElementLattice(const ColumnFootprints& footprints, std::size_t group, int at,
                                     int columns_per_pixel, int rows_per_pixel)
    : columns_(columns_per_pixel), rows_(rows_per_pixel), width_(columns_per_pixel), height_(rows_per_pixel) {
  const double reach = footprints.half_width_px();
  if (footprints.groups() == 1 && !footprints.by_column() && footprints.footprint(0).uniform() &&
      reach <= 0.5) {
    side_ = 2.0 * reach;
    weights_.assign(static_cast<std::size_t>(width_ * height_), 1.0 / (width_ * height_));
    return;
  }
  first_column_ = static_cast<int>(std::floor((0.5 - reach) * columns_));
  first_row_ = static_cast<int>(std::floor((0.5 - reach) * rows_));
  width_ = static_cast<int>(std::ceil((0.5 + reach) * columns_)) - first_column_;
  height_ = static_cast<int>(std::ceil((0.5 + reach) * rows_)) - first_row_;
  double sum = 0.0;
  for (int b = 0; b < height_; ++b)
    for (int a = 0; a < width_; ++a) {
      const double x = static_cast<double>(first_column_ + a) / columns_ - 0.5;
      const double y = static_cast<double>(first_row_ + b) / rows_ - 0.5;
      weights_.push_back(footprints.integral(group, at, x, y, x + 1.0 / columns_, y + 1.0 / rows_));
      sum += weights_.back();
    }
  for (double& w : weights_) w /= sum;
}

SubElementLattices::SubElementLattices(const ColumnFootprints& footprints, PixelRect tile,
                                       int columns_per_pixel, int rows_per_pixel)
    : groups_(footprints.groups()), first_column_(tile.x0), by_column_(footprints.by_column()) {
  for (int column = tile.x0; column < (by_column_ ? tile.x1 : tile.x0 + 1); ++column)
    for (std::size_t group = 0; group < groups_; ++group)
      all_.emplace_back(footprints, group, column, columns_per_pixel, rows_per_pixel);
}

FocalPoint SubElementLattice::at(int column, int row, Point2 within) const {
  const int i = floor_divide(column, columns_), j = floor_divide(row, rows_);
  return at(i, j, column - i * columns_, row - j * rows_, within);
}

FocalPoint SubElementLattice::at(int i, int j, int a, int b, Point2 within) const {
  const double x = (a + within.x) / columns_;
  const double y = (b + within.y) / rows_;
  return {i + 0.5 + side_ * (x - 0.5), j + 0.5 + side_ * (y - 0.5)};
}

Point2 footprint_point(const PixelFootprint& h, Point2 u) {
  const double w = h.half_width_px(), strip = w / 256.0;
  const auto invert = [&](double target, auto below) {
    double low = -w, high = w;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (below(middle) < target ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  const double x = invert(u.x * h.integral(-w, -w, w, w), [&](double t) { return h.integral(-w, -w, t, w); });
  const double a = std::clamp(x - strip, -w, w - strip), b = std::clamp(x + strip, -w + strip, w);
  const double y = invert(u.y * h.integral(a, -w, b, w), [&](double t) { return h.integral(a, -w, b, t); });
  return {x, y};
}

}  // namespace ifov::sampling
