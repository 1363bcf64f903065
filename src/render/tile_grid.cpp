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

}  // namespace ifov::render
