#pragma once

#include <cstddef>

#include "render/image_info.h"
#include "sampling/tile.h"

namespace ifov::render {

/// Takes finished tiles, in any order, from any thread; each pixel comes once.
class TileSink {
 public:
  virtual ~TileSink() = default;
  virtual void begin(const ImageInfo& info) = 0;
  virtual void write(const sampling::TileResult& tile) = 0;
};

/// Hands out the tiles of an earlier run of the same image.
class EarlierTiles {
 public:
  virtual ~EarlierTiles() = default;
  /// The tile at this place in the grid, from any thread; false where it is not to be had.
  virtual bool read(std::size_t index, sampling::TileResult& tile) = 0;
};

}  // namespace ifov::render
