#pragma once

#include <cstddef>
#include <vector>

#include "sampling/pixel_rect.h"

namespace ifov::render {

/// Cuts an image into square tiles of the document's size (the last row and column may be smaller), row by row.
/// The grid belongs to the document: a tile's result depends on it, never on threads or order. Where the image is made of sweeps of so many
/// lines each, no tile has lines of two.
std::vector<sampling::PixelRect> tile_grid(int width_px, int height_px, int tile_px, int sweep_lines = 0);
/// How many rows of tiles that has.
int tile_rows(int height_px, int tile_px, int sweep_lines = 0);

/// The share of the tiles of an image that one job of an array renders: the first of 64 takes tiles 0, 64, 128, ...
struct TileShare {
  int number = 1, count = 1;  ///< from 1
  bool is_whole() const { return count == 1; }
  bool has(std::size_t tile) const {
    return tile % static_cast<std::size_t>(count) + 1 == static_cast<std::size_t>(number);
  }
  friend bool operator==(const TileShare&, const TileShare&) = default;
};

/// Position in that grid of the tile with this upper left corner.
std::size_t tile_index(int x0, int y0, int width_px, int tile_px, int sweep_lines = 0);

}  // namespace ifov::render
