#include "render/tile_grid.h"

#include <algorithm>

namespace ifov::render {

std::vector<sampling::PixelRect> tile_grid(int width_px, int height_px, int tile_px, int sweep_lines) {
  std::vector<sampling::PixelRect> tiles;
  const int together = sweep_lines > 0 ? sweep_lines : height_px;
  for (int first = 0; first < height_px; first += together)
    for (int y = first, last = std::min(first + together, height_px); y < last; y += tile_px)
      for (int x = 0; x < width_px; x += tile_px)
        tiles.push_back({x, y, std::min(x + tile_px, width_px), std::min(y + tile_px, last)});
  return tiles;
}

namespace {

int pieces(int all, int of) { return (all + of - 1) / of; }

int row_of(int y0, int tile_px, int sweep_lines) {
  if (sweep_lines <= 0) return y0 / tile_px;
  return y0 / sweep_lines * pieces(sweep_lines, tile_px) + y0 % sweep_lines / tile_px;
}

}  // namespace

int tile_rows(int height_px, int tile_px, int sweep_lines) {
  return row_of(height_px - 1, tile_px, sweep_lines) + 1;
}

std::size_t tile_index(int x0, int y0, int width_px, int tile_px, int sweep_lines) {
  return static_cast<std::size_t>(row_of(y0, tile_px, sweep_lines)) *
             static_cast<std::size_t>(pieces(width_px, tile_px)) +
         static_cast<std::size_t>(x0 / tile_px);
}

}  // namespace ifov::render
