#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/run_control.h"
#include "render/wings/wing_spots.h"
#include "sampling/field.h"
#include "sampling/pixel_rect.h"

namespace ifov::render {

/// Blocks of the given side that the wings of a tile's pixels need, in pixels.
sampling::PixelRect wing_blocks(const sampling::PixelRect& tile, int block);

/// Cells of one level of the wings (sensor::PsfWings), each looked at by 2 x 2 paths: one in each of its quarters. What paths find
/// within spots is left out: there the mean of the cell's other paths stands.
class WingCells {
 public:
  /// `spots`: where they are; may be null.
  WingCells(sampling::PixelRect pixels, int side, std::uint64_t seed, const CancelToken* cancel,
            const WingSpots* spots, sampling::Field& field);

  int width() const { return pixels_.width() / side_; }
  int height() const { return pixels_.height() / side_; }
  int side() const { return side_; }
  std::size_t count() const { return materials_.size() / 4; }
  int cell_x(std::size_t cell) const { return pixels_.x0 + side_ * (static_cast<int>(cell) % width()); }
  int cell_y(std::size_t cell) const { return pixels_.y0 + side_ * (static_cast<int>(cell) / width()); }
  bool holds(int x, int y) const {
    return x >= pixels_.x0 && x < pixels_.x1 && y >= pixels_.y0 && y < pixels_.y1;
  }
  /// By a pixel in it.
  std::size_t cell_at(int x, int y) const {
    return static_cast<std::size_t>((y - pixels_.y0) / side_) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>((x - pixels_.x0) / side_);
  }
  const float* value(std::size_t cell, int quarter) const {
    return values_.data() + (4 * cell + static_cast<std::size_t>(quarter)) * columns_;
  }
  std::uint32_t material(std::size_t cell, int quarter) const {
    return materials_[4 * cell + static_cast<std::size_t>(quarter)];
  }
  /// Variance of one path about its quarter's mean, by what no plane through the four explains.
  double variance(std::size_t cell, std::size_t column) const {
    const double bend = static_cast<double>(value(cell, 0)[column]) - value(cell, 1)[column] -
                        value(cell, 2)[column] + value(cell, 3)[column];
    return 0.25 * bend * bend;
  }
  double mean(std::size_t cell, std::size_t column) const {
    double sum = 0.0;
    for (int quarter = 0; quarter < 4; ++quarter) sum += value(cell, quarter)[column];
    return 0.25 * sum;
  }

 private:
  void leave_out(std::size_t cell, unsigned in_spots);

  sampling::PixelRect pixels_;
  int side_;
  std::size_t columns_;
  std::vector<float> values_;
  std::vector<std::uint32_t> materials_;
};

}  // namespace ifov::render
