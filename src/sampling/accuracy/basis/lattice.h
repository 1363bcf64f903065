#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sampling/field.h"
#include "sampling/pixel_rect.h"

namespace ifov::sampling {

/// Halvings of a lattice cell: flames of 1e-8 of a pixel are followed. Keys of edges (below) hold no more.
constexpr int kMaxLevel = 15;

/// The integer-keyed lattice of a tile and its halo. Positions count in fine units of 1 / (cells << kMaxLevel) px from the top left corner of the domain; a cell of level l is (1 << kMaxLevel) >>
/// l units wide. The image-wide position of a vertex is what its random numbers are keyed by, so that neighbouring tiles agree about it.
class Lattice {
 public:
  Lattice(PixelRect domain, int cells_per_pixel)
      : domain_(domain),
        cells_(cells_per_pixel),
        units_per_px_(cells_per_pixel << kMaxLevel),
        cells_per_px_inverse_(
            static_cast<std::uint32_t>(0xffffffffu / static_cast<std::uint32_t>(cells_per_pixel)) + 1u),
        unit_px_(1.0 / units_per_px_) {}

  const PixelRect& domain() const { return domain_; }
  int cells_per_pixel() const { return cells_; }
  int columns() const { return domain_.width() * cells_; }  ///< root cells per row
  int rows() const { return domain_.height() * cells_; }
  double unit_px() const { return unit_px_; }
  std::int32_t width() const { return domain_.width() * units_per_px_; }  ///< fine units
  std::int32_t height() const { return domain_.height() * units_per_px_; }
  static constexpr std::int32_t side(int level) { return (std::int32_t{1} << kMaxLevel) >> level; }
  double side_px(int level) const { return side(level) * unit_px_; }

  /// Image coordinates of a fine position; the integer part is added last, so that tiles agree bit for bit.
  double x_px(std::int32_t x) const { return at_px(x, domain_.x0); }
  double y_px(std::int32_t y) const { return at_px(y, domain_.y0); }
  FocalPoint point(std::int32_t x, std::int32_t y) const { return {x_px(x), y_px(y)}; }

  /// Row-major index in the domain of the pixel that holds an image point; points on the rim go inside.
  int pixel_at(FocalPoint p) const {
    return clamp_index(static_cast<int>(std::floor(p.y_px)) - domain_.y0, domain_.height()) *
               domain_.width() +
           clamp_index(static_cast<int>(std::floor(p.x_px)) - domain_.x0, domain_.width());
  }
  /// The same for the top left corner of a cell.
  int pixel_of_cell(std::int32_t x, std::int32_t y) const {
    return clamp_index(whole_px(y), domain_.height()) * domain_.width() +
           clamp_index(whole_px(x), domain_.width());
  }

  /// Whether a position is one of the lattice's own vertices, and its row-major number if it is.
  static bool on_lattice(std::int32_t x, std::int32_t y) { return ((x | y) & (side(0) - 1)) == 0; }
  std::size_t vertex_number(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>((y >> kMaxLevel) * (columns() + 1) + (x >> kMaxLevel));
  }
  FocalPoint vertex_point(std::size_t number) const {
    const auto row = static_cast<std::size_t>(columns()) + 1;
    return point(static_cast<std::int32_t>(number % row) * side(0),
                 static_cast<std::int32_t>(number / row) * side(0));
  }
  /// The first of a pixel's cells among those of the lattice, row by row; rows are columns() apart.
  std::uint32_t first_cell(int pixel) const {
    const int width = domain_.width();
    return static_cast<std::uint32_t>((pixel / width * columns() + pixel % width) * cells_);
  }

  /// The number of the vertex in a pixel's corner; rows of vertices are columns() + 1 apart.
  std::size_t first_vertex(int pixel) const {
    const int width = domain_.width(), row = columns() + 1;
    return static_cast<std::size_t>(pixel / width * cells_) * static_cast<std::size_t>(row) +
           static_cast<std::size_t>(pixel % width * cells_);
  }

  /// Keys within the domain, for tables.
  static std::uint64_t vertex_key(std::int32_t x, std::int32_t y) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) | static_cast<std::uint32_t>(y);
  }
  static std::uint64_t edge_key(std::int32_t x, std::int32_t y, bool vertical, int level) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 34) |
           (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 5) |
           (static_cast<std::uint64_t>(level) << 1) | static_cast<std::uint64_t>(vertical);
  }

  /// Image-wide position, for random numbers: the same for a vertex whatever is left to the finest levels.
  std::int64_t image_x(std::int32_t x) const { return image_wide(domain_.x0, x); }
  std::int64_t image_y(std::int32_t y) const { return image_wide(domain_.y0, y); }

 private:
  std::int64_t image_wide(int origin, std::int32_t fine) const {
    constexpr int kFinest = 6;  // levels
    const std::int64_t at = static_cast<std::int64_t>(origin) * units_per_px_ + fine;
    return (at >> kFinest) ^ static_cast<std::int64_t>(static_cast<std::uint64_t>(at) << (64 - kFinest));
  }
  static int clamp_index(int i, int count) { return i < 0 ? 0 : i >= count ? count - 1 : i; }
  double at_px(std::int32_t fine, int origin) const {
    const std::int32_t whole = whole_px(fine);
    return (origin + whole) + (fine - whole * units_per_px_) * unit_px_;
  }

  /// fine / units_per_px_ for fine >= 0, by a multiplication: exact while there are fewer than 2^26 root cells a side.
  std::int32_t whole_px(std::int32_t fine) const {
    const auto root = static_cast<std::uint32_t>(fine) >> kMaxLevel;
    return cells_ == 1 ? static_cast<std::int32_t>(root)
                       : static_cast<std::int32_t>((std::uint64_t{root} * cells_per_px_inverse_) >> 32);
  }

  PixelRect domain_;
  int cells_;
  std::int32_t units_per_px_;
  std::uint32_t cells_per_px_inverse_;
  double unit_px_;
};

}  // namespace ifov::sampling
