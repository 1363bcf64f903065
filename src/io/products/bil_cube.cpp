#include "io/products/bil_cube.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "core/format.h"

namespace ifov::io {
namespace {

// Bands turned together: a block of them for one tile row stays in the first-level cache.
constexpr int kBandBlock = 16;

// Lines are gathered into pieces of about this many values before they are written.
constexpr std::size_t kPieceWords = std::size_t{1} << 20;

std::size_t words(int a, int b = 1, int c = 1) {
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
}

/// [pixel][band] of one tile to [row][band][x], the values' bits unchanged.
template <class T>
std::unique_ptr<std::uint32_t[]> turned(sampling::PixelRect tile, int bands, std::span<const T> values) {
  if (values.size() != words(tile.width(), tile.height(), bands))
    throw std::logic_error("a tile's values do not match its size");
  auto result = std::make_unique_for_overwrite<std::uint32_t[]>(values.size());
  const std::size_t width = words(tile.width()), band_count = words(bands);
  for (int row = 0; row < tile.height(); ++row) {
    const T* from = values.data() + words(row, tile.width(), bands);
    std::uint32_t* to = result.get() + words(row, tile.width(), bands);
    for (std::size_t first = 0; first < band_count; first += kBandBlock) {
      const std::size_t last = std::min<std::size_t>(first + kBandBlock, band_count);
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t band = first; band < last; ++band)
          to[band * width + x] = std::bit_cast<std::uint32_t>(from[x * band_count + band]);
    }
  }
  return result;
}

}  // namespace

BilCube::BilCube(std::filesystem::path path, int width, int height, int bands, Values values,
                 std::size_t buffer_limit_bytes)
    : width_(width),
      height_(height),
      bands_(bands),
      values_(values),
      buffer_limit_bytes_(buffer_limit_bytes),
      file_(std::move(path)) {
  static_assert(std::endian::native == std::endian::little, "headers say byte order = 0");
}

std::uint64_t BilCube::bytes() const {
  return std::uint64_t{4} * static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_) *
         static_cast<std::uint64_t>(bands_);
}

void BilCube::write(sampling::PixelRect tile, std::span<const float> values) {
  add(tile, turned(tile, bands_, values));
}

void BilCube::write(sampling::PixelRect tile, std::span<const std::uint32_t> values) {
  add(tile, turned(tile, bands_, values));
}

void BilCube::add(sampling::PixelRect tile, std::unique_ptr<std::uint32_t[]> values) {
  if (tile.x0 < 0 || tile.y0 < 0 || tile.x1 > width_ || tile.y1 > height_ || tile.x0 >= tile.x1 ||
      tile.y0 >= tile.y1)
    throw std::logic_error("a tile lies outside the image");
  Strip ready;
  {
    const std::lock_guard lock(mutex_);
    const auto key = std::pair(tile.y0, tile.y1);
    Strip& strip = strips_[key];
    strip.y0 = tile.y0;
    strip.y1 = tile.y1;
    strip.pixels += tile.count();
    strip.blocks.push_back({tile.x0, tile.width(), std::move(values)});
    buffered_bytes_ += 4 * words(tile.width(), tile.height(), bands_);
    if (strip.pixels == static_cast<std::int64_t>(width_) * tile.height()) {
      ready = take(strips_.find(key));
    } else if (buffered_bytes_ > buffer_limit_bytes_) {
      ready = take(std::max_element(strips_.begin(), strips_.end(), [this](const auto& a, const auto& b) {
        return strip_bytes(a.second) < strip_bytes(b.second);
      }));
    }
  }
  write_strip(std::move(ready));
}

BilCube::Strip BilCube::take(std::map<std::pair<int, int>, Strip>::iterator place) {
  Strip strip = std::move(place->second);
  strips_.erase(place);
  buffered_bytes_ -= strip_bytes(strip);
  return strip;
}

std::size_t BilCube::strip_bytes(const Strip& strip) const {
  return 4 * static_cast<std::size_t>(strip.pixels) * words(bands_);
}

void BilCube::flush() {
  while (true) {
    Strip strip;
    {
      const std::lock_guard lock(mutex_);
      if (strips_.empty()) return;
      strip = take(strips_.begin());
    }
    write_strip(std::move(strip));
  }
}

void BilCube::write_strip(Strip strip) {
  auto& blocks = strip.blocks;
  std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.x0 < b.x0; });
  for (std::size_t first = 0; first < blocks.size();) {
    std::size_t last = first + 1;  // blocks [first, last) lie side by side
    while (last < blocks.size() && blocks[last].x0 == blocks[last - 1].x0 + blocks[last - 1].width) ++last;
    write_run(strip, first, last);
    first = last;
  }
}

void BilCube::write_run(const Strip& strip, std::size_t first, std::size_t last) {
  const int x0 = strip.blocks[first].x0;
  const int run = strip.blocks[last - 1].x0 + strip.blocks[last - 1].width - x0;
  const int rows = strip.y1 - strip.y0;
  const std::size_t line_words = words(run, bands_);
  const int lines_at_once =
      static_cast<int>(std::clamp<std::size_t>(kPieceWords / line_words, 1, static_cast<std::size_t>(rows)));
  auto piece = std::make_unique_for_overwrite<std::uint32_t[]>(line_words * words(lines_at_once));

  for (int row0 = 0; row0 < rows; row0 += lines_at_once) {
    const int row1 = std::min(row0 + lines_at_once, rows);
    for (int row = row0; row < row1; ++row) {
      std::uint32_t* line = piece.get() + line_words * words(row - row0);
      for (std::size_t b = first; b < last; ++b) {
        const Block& block = strip.blocks[b];
        const std::uint32_t* from = block.words.get() + words(row, block.width, bands_);
        std::uint32_t* to = line + (block.x0 - x0);
        for (int band = 0; band < bands_; ++band, from += block.width, to += run)
          std::memcpy(to, from, 4 * words(block.width));
      }
    }
    if (run == width_) {
      file_.write_at(4 * words(strip.y0 + row0) * line_words, piece.get(),
                     4 * line_words * words(row1 - row0));
      continue;
    }
    for (int row = row0; row < row1; ++row)
      for (int band = 0; band < bands_; ++band) {
        const std::size_t target = (words(strip.y0 + row, bands_) + words(band)) * words(width_) + words(x0);
        file_.write_at(4 * target, piece.get() + line_words * words(row - row0) + words(band, run),
                       4 * words(run));
      }
  }
}

RasterView BilCube::view() const {
  return {width_, height_, bands_, [this](int line, int band, std::span<float> values) {
            const std::uint64_t offset = 4 * (words(line, bands_) + words(band)) * words(width_);
            file_.read_at(offset, values.data(), 4 * words(width_));
            if (values_ == Values::integer)
              for (int x = 0; x < width_; ++x) {
                float& value = values[static_cast<std::size_t>(x)];
                value = static_cast<float>(std::bit_cast<std::uint32_t>(value));
              }
          }};
}

}  // namespace ifov::io
