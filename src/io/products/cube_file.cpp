#include "io/products/cube_file.h"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>

#include "io/product_parts/turned_bands.h"

namespace ifov::io {
namespace {

// Rows of such lengths in values would share the same few sets of the caches: turning bands then takes 2.5
// times as long.
constexpr int kBadStride = 256;
constexpr int kPadding = 16;

/// Two strips of a wide image, so that a new one need not drive out one that is nearly whole.
constexpr std::size_t kRoomForTwo = std::size_t{512} << 20;

/// Larger strips are not written in the background: each takes as much memory again.
constexpr std::size_t kLargestSent = std::size_t{256} << 20;

std::size_t value_bytes_of(CubeFile::Values values) {
  switch (values) {
    case CubeFile::Values::byte: return 1;
    case CubeFile::Values::bits: return 2;
    case CubeFile::Values::wide: return 8;
    case CubeFile::Values::real:
    case CubeFile::Values::integer: return 4;
  }
  return 0;
}

constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// Of lines by pixel that are kept turned for those who look at them by bands: the rows of GeoTIFF's tiles.
constexpr std::size_t kTurnedBytes = std::size_t{256} << 20;

std::size_t product(int a, int b = 1, int c = 1) {
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
}

}  // namespace

void CubeFile::Free::operator()(void* memory) const { std::free(memory); }

CubeFile::CubeFile(std::filesystem::path path, int width, int height, int bands, Values values, Limits limits,
                   PartFile::Left left, EnviInterleave interleave)
    : width_(width),
      height_(height),
      bands_(bands),
      stride_(width % kBadStride == 0 && interleave != EnviInterleave::bip ? width + kPadding : width),
      values_(values),
      interleave_(bands == 1 ? EnviInterleave::bil : interleave),
      value_bytes_(value_bytes_of(values)),
      limits_(limits),
      file_(std::move(path), left),
      scan_(width, bands, value_bytes_, interleave_) {
  static_assert(std::endian::native == std::endian::little, "headers say byte order = 0");
  if (value_bytes_ < 4 && bands != 1) throw std::logic_error("cubes of small values have one band");
  if (bytes() >= limits_.large_bytes) file_.bypass_page_cache();
  if (by_pixel())
    turned_ = std::make_unique<TurnedLines>(
        width, bands, value_bytes_,
        [this](std::uint64_t offset, void* to, std::size_t count) { file_.read_at(offset, to, count); },
        kTurnedBytes);
}

std::uint64_t CubeFile::waiting_bytes(int width, int height, int bands, int tile_rows, int value_bytes) {
  const std::size_t value = product(value_bytes),
                    strip = value * product(width, std::min(tile_rows, height), bands);
  const bool sent = value * product(width, height, bands) >= kManyBytes && strip <= kLargestSent;
  return std::max(strip, std::min(2 * strip, kRoomForTwo)) + (sent ? strip : 0);
}

std::uint64_t CubeFile::bytes() const { return value_bytes_ * product(width_, height_, bands_); }

void CubeFile::write(sampling::PixelRect tile, std::span<const float> values) {
  add(tile, values.data(), values.size());
}

void CubeFile::write(sampling::PixelRect tile, std::span<const std::uint32_t> values) {
  add(tile, values.data(), values.size());
}

void CubeFile::write(sampling::PixelRect tile, std::span<const std::uint8_t> values) {
  add(tile, values.data(), values.size());
}

void CubeFile::write(sampling::PixelRect tile, std::span<const double> values) {
  add(tile, values.data(), values.size());
}

void CubeFile::write(sampling::PixelRect tile, std::span<const std::uint16_t> values) {
  add(tile, values.data(), values.size());
}

void CubeFile::add(sampling::PixelRect tile, const void* values, std::size_t count) {
  if (tile.x0 < 0 || tile.y0 < 0 || tile.x1 > width_ || tile.y1 > height_ || tile.x0 >= tile.x1 ||
      tile.y0 >= tile.y1)
    throw std::logic_error("a tile lies outside the image");
  if (count != product(tile.width(), tile.height(), bands_))
    throw std::logic_error("a tile's values do not match its size");

  const auto strip = enter(tile);
  const auto* from = static_cast<const std::byte*>(values);
  for (int row = 0; row < tile.height(); ++row) {
    const std::byte* const line = from + value_bytes_ * product(row, tile.width(), bands_);
    if (by_pixel()) {
      std::memcpy(
          strip->buffer.get() + value_bytes_ * (product(row, width_) + product(tile.x0)) * product(bands_),
          line, value_bytes_ * product(tile.width(), bands_));
      continue;
    }
    std::byte* const to =
        strip->buffer.get() + value_bytes_ * (product(row, stride_, bands_) + product(tile.x0));
    if (bands_ == 1)
      std::memcpy(to, line, value_bytes_ * product(tile.width()));
    else
      turn_bands(line, product(tile.width()), product(bands_), to, product(stride_), value_bytes_);
  }
  for (Strip& ready : leave(strip, tile)) send(std::move(ready));
}

void CubeFile::send(Strip strip) {
  if (!in_background(strip.bytes)) return write_strip(strip);
  strip.scanned = is_whole(strip) && scan_in_turn(strip);
  const std::lock_guard lock(sending_mutex_);
  if (sending_.valid()) sending_.get();
  const auto sent = std::make_shared<Strip>(std::move(strip));
  try {
    sending_ = std::async(std::launch::async, [this, sent] { write_strip(*sent); });
  } catch (const std::system_error&) {  // no further thread may be made
    write_strip(*sent);
  }
}

CubeFile::Strips::iterator CubeFile::enter(sampling::PixelRect tile) {
  const std::lock_guard lock(mutex_);
  auto strip = std::find_if(strips_.begin(), strips_.end(),
                            [&](const Strip& s) { return s.y0 == tile.y0 && s.y1 == tile.y1; });
  if (strip == strips_.end()) {
    Strip fresh;
    fresh.y0 = tile.y0;
    fresh.y1 = tile.y1;
    fresh.bytes = value_bytes_ * product(stride_, tile.height(), bands_);
    fresh.buffer = new_buffer(fresh.bytes);
    buffered_bytes_ += fresh.bytes;
    strips_.push_front(std::move(fresh));
    strip = strips_.begin();
  }
  ++strip->writers;
  return strip;
}

/// The strips that are to be written now.
CubeFile::Strips CubeFile::leave(Strips::iterator strip, sampling::PixelRect tile) {
  const std::lock_guard lock(mutex_);
  const std::size_t strip_bytes = strip->bytes;
  --strip->writers;
  strip->pixels += tile.count();
  strip->extents.emplace_back(tile.x0, tile.x1);
  Strips ready;
  const auto take = [&](Strips::iterator which) {
    buffered_bytes_ -= which->bytes;
    ready.splice(ready.end(), strips_, which);
  };
  if (strip->writers == 0 && is_whole(*strip)) take(strip);
  // Too many open strips: the fullest that nobody is at work in goes, whole or not.
  while (buffered_bytes_ > buffer_limit(strip_bytes)) {
    auto fullest = strips_.end();
    for (auto s = strips_.begin(); s != strips_.end(); ++s)
      if (s->writers == 0 && (fullest == strips_.end() || s->pixels > fullest->pixels)) fullest = s;
    if (fullest == strips_.end()) break;
    take(fullest);
  }
  return ready;
}

bool CubeFile::is_whole(const Strip& strip) const {
  return strip.pixels == static_cast<std::int64_t>(width_) * (strip.y1 - strip.y0);
}

bool CubeFile::in_background(std::size_t strip_bytes) const {
  return bytes() >= limits_.large_bytes && strip_bytes <= kLargestSent;
}

/// One strip at least: pieces of a tile's width go out in thousands of small writes.
std::size_t CubeFile::buffer_limit(std::size_t strip_bytes) const {
  return std::max({limits_.buffer_bytes, std::min(2 * strip_bytes, kRoomForTwo), strip_bytes});
}

CubeFile::Buffer CubeFile::new_buffer(std::size_t bytes) {
  if (!spares_.empty() && spare_bytes_ == bytes) {
    Buffer buffer = std::move(spares_.back());
    spares_.pop_back();
    return buffer;
  }
  const std::size_t alignment = bytes >= kHugePage ? kHugePage : 64;
  const std::size_t size = (bytes + alignment - 1) / alignment * alignment;
  Buffer buffer(static_cast<std::byte*>(std::aligned_alloc(alignment, size)));
  if (!buffer) throw std::bad_alloc();
  if (bytes >= kHugePage) madvise(buffer.get(), size, MADV_HUGEPAGE);
  return buffer;
}

void CubeFile::flush() {
  if (sending_.valid()) sending_.get();
  for (Strip& strip : strips_) write_strip(strip);
  strips_.clear();
  buffered_bytes_ = 0;
  spares_.clear();
}

void CubeFile::write_strip(Strip& strip) {
  if (is_whole(strip)) {
    write_whole(strip);
    scan_written(strip);
  } else {
    std::sort(strip.extents.begin(), strip.extents.end());
    for (std::size_t first = 0; first < strip.extents.size();) {
      std::size_t last = first;  // extents [first, last] lie side by side
      while (last + 1 < strip.extents.size() && strip.extents[last + 1].first == strip.extents[last].second)
        ++last;
      write_segments(strip, strip.extents[first].first, strip.extents[last].second);
      first = last + 1;
    }
  }
  const std::lock_guard lock(mutex_);
  note_written(strip);
  if (spare_bytes_ != strip.bytes) spares_.clear();
  spare_bytes_ = strip.bytes;
  const std::size_t sent = in_background(strip.bytes) ? strip.bytes : 0;
  if (buffered_bytes_ + (spares_.size() + 1) * spare_bytes_ <= buffer_limit(spare_bytes_) + sent)
    spares_.push_back(std::move(strip.buffer));
}

void CubeFile::write_whole(const Strip& strip) {
  const std::size_t rows = product(strip.y1 - strip.y0), bands = product(bands_);
  if (interleave_ == EnviInterleave::bsq) {
    std::vector<iovec> pieces(rows);
    for (int band = 0; band < bands_; ++band) {
      for (std::size_t row = 0; row < rows; ++row)
        pieces[row] = {strip.buffer.get() + value_bytes_ * (row * bands + product(band)) * product(stride_),
                       value_bytes_ * product(width_)};
      file_.write_at(value_bytes_ * layout().place(0, strip.y0, band), pieces);
    }
    return;
  }
  std::vector<iovec> pieces(stride_ == width_ ? 1 : rows * bands);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    pieces[k] = {strip.buffer.get() + value_bytes_ * k * product(stride_),
                 value_bytes_ * product(width_) * (rows * bands / pieces.size())};
  file_.write_at(value_bytes_ * layout().place(0, strip.y0, 0), pieces);
}

void CubeFile::write_segments(const Strip& strip, int x0, int x1) {
  const std::size_t bytes = value_bytes_ * product(x1 - x0);
  for (int row = 0; row < strip.y1 - strip.y0; ++row) {
    if (by_pixel()) {
      file_.write_at(
          value_bytes_ * layout().place(x0, strip.y0 + row, 0),
          strip.buffer.get() + value_bytes_ * (product(row, width_) + product(x0)) * product(bands_),
          bytes * product(bands_));
      continue;
    }
    for (int band = 0; band < bands_; ++band) {
      const std::size_t in_strip = (product(row, bands_) + product(band)) * product(stride_) + product(x0);
      file_.write_at(value_bytes_ * layout().place(x0, strip.y0 + row, band),
                     strip.buffer.get() + value_bytes_ * in_strip, bytes);
    }
  }
}

/// Pieces of a strip may come one by one, where memory is short.
void CubeFile::note_written(const Strip& strip) {
  written_[{strip.y0, strip.y1}] += strip.pixels;
  while (!written_.empty()) {
    const auto& [rows, pixels] = *written_.begin();
    const auto [y0, y1] = rows;
    if (y0 != lines_written_ || pixels < static_cast<std::int64_t>(width_) * (y1 - y0)) return;
    lines_written_ = y1;
    written_.erase(written_.begin());
  }
}

/// False where earlier lines are missing.
bool CubeFile::scan_in_turn(const Strip& strip) {
  const std::lock_guard lock(scan_mutex_);
  if (strip.y0 != scan_.lines()) return false;
  for (int row = 0; row < strip.y1 - strip.y0; ++row)
    scan_.take(strip.buffer.get() + value_bytes_ * product(row, stride_, bands_),
               value_bytes_ * product(stride_));
  return true;
}

void CubeFile::scan_written(const Strip& strip) {
  const bool scanned = strip.scanned || scan_in_turn(strip);
  const std::lock_guard lock(scan_mutex_);
  if (!scanned) unscanned_[strip.y0] = strip.y1;
  while (!unscanned_.empty() && unscanned_.begin()->first == scan_.lines()) {
    scan_file(unscanned_.begin()->second);
    unscanned_.erase(unscanned_.begin());
  }
}

void CubeFile::finish_scan() {
  scan_file(height_);
  if (interleave_ != EnviInterleave::bsq) return;
  constexpr std::uint64_t kPiece = std::uint64_t{4} << 20;
  std::vector<std::byte> piece(std::min(kPiece, bytes()));
  for (std::uint64_t at = 0; at < bytes(); at += piece.size()) {
    const std::span<std::byte> part(piece.data(), std::min<std::uint64_t>(piece.size(), bytes() - at));
    file_.read_at(at, part.data(), part.size());
    scan_.add_bytes(part);
  }
}

void CubeFile::scan_file(int line_end) {
  const std::size_t row = value_bytes_ * product(width_), bytes = row * product(bands_);
  const auto line = std::make_unique_for_overwrite<std::byte[]>(bytes);
  while (scan_.lines() < line_end) {
    if (interleave_ == EnviInterleave::bsq)
      for (int band = 0; band < bands_; ++band) fetch(scan_.lines(), band, line.get() + row * product(band));
    else
      file_.read_at(bytes * product(scan_.lines()), line.get(), bytes);
    scan_.take(line.get(), row);
  }
}

/// One line of one band.
void CubeFile::fetch(int line, int band, void* to) const {
  const std::size_t bytes = value_bytes_ * product(width_);
  if (turned_)
    std::memcpy(to, turned_->line(line)->data() + bytes * product(band), bytes);
  else
    file_.read_at(value_bytes_ * layout().place(0, line, band), to, bytes);
}

RasterView CubeFile::view() const {
  return {width_, height_, bands_, [this](int line, int band, std::span<float> values) {
            if (value_bytes_ == 4) {
              fetch(line, band, values.data());
              if (values_ == Values::integer)
                for (float& value : values) value = static_cast<float>(std::bit_cast<std::uint32_t>(value));
              return;
            }
            if (value_bytes_ == 8) {
              std::vector<double> wide(product(width_));
              fetch(line, band, wide.data());
              std::transform(wide.begin(), wide.end(), values.begin(),
                             [](double value) { return static_cast<float>(value); });
              return;
            }
            std::vector<std::uint8_t> small(value_bytes_ * product(width_));
            fetch(line, band, small.data());
            for (std::size_t x = 0; x < product(width_); ++x)
              values[x] =
                  value_bytes_ == 1 ? small[x] : static_cast<float>(small[2 * x] | small[2 * x + 1] << 8);
          }};
}

WideView CubeFile::wide_view() const {
  if (values_ != Values::wide) return {};
  return {width_, height_, bands_,
          [this](int line, int band, std::span<double> values) { fetch(line, band, values.data()); }};
}

}  // namespace ifov::io
