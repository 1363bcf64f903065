#pragma once

#include <optional>

namespace ifov::render {

/// Hands out the tiles that are to be rendered, to threads that call from anywhere.
class TileSource {
 public:
  virtual ~TileSource() = default;
  /// A position in the image's grid of tiles, each once; nothing when there are no more. May wait.
  virtual std::optional<int> next() = 0;
};

}  // namespace ifov::render
