#include "render/tile_grid.h"

#include <algorithm>

namespace ifov::render {

std::vector<sampling::PixelRect> tile_grid(int width_px, int height_px, int tile_px) {
  std::vector<sampling::PixelRect> tiles;
  for (int y = 0; y < height_px; y += tile_px)
    for (int x = 0; x < width_px; x += tile_px)
      tiles.push_back({x, y, std::min(x + tile_px, width_px), std::min(y + tile_px, height_px)});
  return tiles;
}

std::size_t tile_index(int x0, int y0, int width_px, int tile_px) {
  const int columns = (width_px + tile_px - 1) / tile_px;
  return static_cast<std::size_t>(y0 / tile_px) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(x0 / tile_px);
}

}  // namespace ifov::render
