#pragma once

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "io/product_parts/image_error.h"
#include "render/tile_sink.h"

namespace ifov::session {

/// Passes tiles on and adds up what they know of the error of the image as a whole.
class ImageErrors final : public render::TileSink {
 public:
  explicit ImageErrors(render::TileSink& next) : next_(next) {}
  void begin(const render::ImageInfo& info) override { next_.begin(info); }
  void write(const sampling::TileResult& tile) override;
  /// By channel; empty where no tile knows any. The same in whichever order tiles came.
  std::vector<io::ImageError> errors() const;

 private:
  render::TileSink& next_;
  mutable std::mutex mutex_;
  struct Tile {
    std::vector<sampling::ColumnError> columns;
    std::size_t pixels;
  };
  std::map<std::pair<int, int>, Tile> tiles_;  ///< by the row and column of their first pixel
};

/// "Reached in 208 of 210 channels: ..." of what was asked of the image; or what an audit found where nothing was.
std::string image_error_statement(const std::vector<io::ImageError>& errors, const render::ImageInfo& image);

}  // namespace ifov::session
