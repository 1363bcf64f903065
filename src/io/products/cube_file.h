#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "io/envi/cube_layout.h"
#include "io/product_parts/cube_scan.h"
#include "io/product_parts/raster_view.h"
#include "io/product_parts/turned_lines.h"
#include "io/products/part_file.h"
#include "sampling/tile.h"

namespace ifov::io {

/// A cube, filled tile by tile in any order, from any thread. Tiles side by side are gathered in memory into whole lines, which go
/// out in one piece (band by band where the cube is band sequential): a line of one band of one tile is only some dozen bytes. What waits is bounded (`Limits::buffer_bytes`, or two strips up to 512 MiB, or
/// one strip); beyond it incomplete strips are written segment by segment. Large cubes go past the page cache,
/// one more strip in the background; a failure there is thrown by the next write() or flush().
class CubeFile {
 public:
  /// float; unsigned of 32, 16, 8 bits; double. 16 and 8 bits of one band alone.
  enum class Values { real, integer, bits, byte, wide };
  struct Limits {
    std::size_t buffer_bytes = std::size_t{192} << 20;
    std::uint64_t large_bytes = kManyBytes;  ///< of a large cube
  };

  CubeFile(std::filesystem::path path, int width, int height, int bands, Values values, Limits limits,
           PartFile::Left left = PartFile::Left::replace, EnviInterleave interleave = EnviInterleave::bil);
  CubeFile(std::filesystem::path path, int width, int height, int bands, Values values,
           PartFile::Left left = PartFile::Left::replace, EnviInterleave interleave = EnviInterleave::bil)
      : CubeFile(std::move(path), width, height, bands, values, Limits(), left, interleave) {}

  /// What waits of a cube whose tiles, so high, come line by line.
  static std::uint64_t waiting_bytes(int width, int height, int bands, int tile_rows, int value_bytes = 4);

  void reserve() { file_.reserve(bytes()); }
  std::uint64_t bytes() const;
  int bands() const { return bands_; }
  CubeLayout layout() const { return {interleave_, width_, height_, bands_}; }

  /// Values as [pixel * bands + band], pixels row by row.
  void write(sampling::PixelRect tile, std::span<const float> values);
  void write(sampling::PixelRect tile, std::span<const std::uint32_t> values);
  void write(sampling::PixelRect tile, std::span<const std::uint16_t> values);
  void write(sampling::PixelRect tile, std::span<const std::uint8_t> values);
  void write(sampling::PixelRect tile, std::span<const double> values);

  /// Writes all that waits; no write() may be under way.
  void flush();

  /// Image lines [0, lines_written()) were written whole. From any thread.
  int lines_written() const { return lines_written_; }

  /// What is told of the cube. Lines pass as they are written, or are read back where a later one came first; bytes of a
  /// band-sequential cube, which come in another order, pass in finish_scan().
  CubeScan& scan() { return scan_; }
  /// After flush(): lets the lines pass that have not yet.
  void finish_scan();

  /// After flush(): one line of one band as floats; integer cubes are converted. Valid as long as the cube
  /// is.
  RasterView view() const;
  /// The same of a cube of doubles; of others empty.
  WideView wide_view() const;

  PartFile& file() { return file_; }
  const PartFile& file() const { return file_; }

 private:
  struct Free {
    void operator()(void* memory) const;
  };
  using Buffer = std::unique_ptr<std::byte, Free>;

  /// All tiles that share their first and last line: [row][band][x], x padded to stride_; by pixel [row][x][band].
  struct Strip {
    int y0 = 0, y1 = 0;
    std::int64_t pixels = 0;  // finished
    int writers = 0;          // at work in it
    bool scanned = false;
    std::vector<std::pair<int, int>> extents;  // [x0, x1) of finished tiles
    Buffer buffer;
    std::size_t bytes = 0;
  };
  using Strips = std::list<Strip>;

  void add(sampling::PixelRect tile, const void* values, std::size_t count);
  Strips::iterator enter(sampling::PixelRect tile);
  Strips leave(Strips::iterator strip, sampling::PixelRect tile);
  bool is_whole(const Strip& strip) const;
  bool in_background(std::size_t strip_bytes) const;
  void send(Strip strip);
  void write_strip(Strip& strip);
  void write_segments(const Strip& strip, int x0, int x1);
  void note_written(const Strip& strip);  // under the lock
  bool by_pixel() const { return interleave_ == EnviInterleave::bip; }
  void fetch(int line, int band, void* to) const;
  void write_whole(const Strip& strip);
  bool scan_in_turn(const Strip& strip);
  void scan_written(const Strip& strip);
  void scan_file(int line_end);
  Buffer new_buffer(std::size_t bytes);
  std::size_t buffer_limit(std::size_t strip_bytes) const;

  int width_, height_, bands_;
  int stride_;  // of a row in memory
  Values values_;
  EnviInterleave interleave_;  // of one band bil: all are the same
  std::size_t value_bytes_;
  Limits limits_;
  PartFile file_;
  std::unique_ptr<const TurnedLines> turned_;  // of cubes by pixel, for those who look at them by bands
  std::mutex mutex_;
  Strips strips_;
  std::size_t buffered_bytes_ = 0;
  std::vector<Buffer> spares_;  // of strips that were written: fresh pages cost more than filling them
  std::size_t spare_bytes_ = 0;

  // Pixels in the file of [y0, y1), of or before which some are missing.
  std::map<std::pair<int, int>, std::int64_t> written_;
  std::atomic<int> lines_written_{0};

  std::mutex scan_mutex_;
  CubeScan scan_;
  std::map<int, int> unscanned_;  // whole strips in the file, [y0, y1), before which lines are missing

  std::mutex sending_mutex_;
  std::future<void> sending_;  // the last member: it ends before what it uses does
};

}  // namespace ifov::io
