#pragma once

#include <vector>

#include "sampling/tile.h"

namespace ifov::render {

/// Cuts an image into square tiles of the document's size (the last row and column may be smaller), row by row.
/// The grid belongs to the document: a tile's result depends on it, never on threads or order.
std::vector<sampling::PixelRect> tile_grid(int width_px, int height_px, int tile_px);

}  // namespace ifov::render
