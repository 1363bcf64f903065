#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "io/products/part_file.h"
#include "io/products/raster_view.h"
#include "sampling/tile.h"

namespace ifov::io {

/// A band-interleaved-by-line cube of 4-byte values, filled tile by tile in any order, from any thread. Tiles
/// side by side wait in memory until they make whole lines, which go out in one piece: a line of one band of
/// one tile is only some dozen bytes. What waits is bounded; beyond it incomplete strips are written segment
/// by segment.
class BilCube {
 public:
  enum class Values { real, integer };  ///< float or 32-bit unsigned
  BilCube(std::filesystem::path path, int width, int height, int bands, Values values = Values::real,
          std::size_t buffer_limit_bytes = std::size_t{192} << 20);

  void reserve() { file_.reserve(bytes()); }
  std::uint64_t bytes() const;
  int width() const { return width_; }
  int height() const { return height_; }
  int bands() const { return bands_; }

  /// Values as [pixel * bands + band], pixels row by row.
  void write(sampling::PixelRect tile, std::span<const float> values);
  void write(sampling::PixelRect tile, std::span<const std::uint32_t> values);

  /// Writes all that waits.
  void flush();

  /// After flush(): one line of one band as floats; integer cubes are converted. Valid as long as the cube
  /// is.
  RasterView view() const;

  PartFile& file() { return file_; }
  const PartFile& file() const { return file_; }

 private:
  struct Block {  // one tile, turned to [row][band][x]
    int x0 = 0, width = 0;
    std::unique_ptr<std::uint32_t[]> words;
  };
  struct Strip {
    int y0 = 0, y1 = 0;
    std::int64_t pixels = 0;
    std::vector<Block> blocks;
  };

  void add(sampling::PixelRect tile, std::unique_ptr<std::uint32_t[]> values);
  Strip take(std::map<std::pair<int, int>, Strip>::iterator place);
  void write_strip(Strip strip);
  void write_run(const Strip& strip, std::size_t first, std::size_t last);
  std::size_t strip_bytes(const Strip& strip) const;

  int width_, height_, bands_;
  Values values_;
  std::size_t buffer_limit_bytes_;
  PartFile file_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, Strip> strips_;  // by first and last line
  std::size_t buffered_bytes_ = 0;
};

}  // namespace ifov::io
