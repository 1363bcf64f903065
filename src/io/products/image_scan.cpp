#include "io/products/image_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "io/products/sha256.h"

namespace ifov::io {
namespace {

struct Sums {
  double sum = 0.0, squares = 0.0;  // about the channel's first finite value
  double offset = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
  std::uint64_t finite = 0, total = 0;

  void add(std::span<const float> values) {
    for (const float value : values) {
      ++total;
      if (!std::isfinite(value)) continue;
      if (finite++ == 0) offset = value;
      const double v = value - offset;
      sum += v;
      squares += v * v;
      low = std::min<double>(low, value);
      high = std::max<double>(high, value);
    }
  }
};

}  // namespace

std::string checksum(const PartFile& file, std::uint64_t bytes) {
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
  const auto piece = std::make_unique_for_overwrite<char[]>(kPiece);
  Sha256 sum;
  for (std::uint64_t offset = 0; offset < bytes; offset += kPiece) {
    const std::size_t size = std::min(kPiece, bytes - offset);
    file.read_at(offset, piece.get(), size);
    sum.update(piece.get(), size);
  }
  return sum.digest();
}

std::vector<ChannelStatistics> channel_statistics(const RasterView& radiance, const RasterView* half_width) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto bands = static_cast<std::size_t>(radiance.bands);
  std::vector<Sums> values(bands), widths(bands);
  std::vector<float> line(static_cast<std::size_t>(radiance.width));
  for (int y = 0; y < radiance.height; ++y)
    for (int b = 0; b < radiance.bands; ++b) {
      radiance.read(y, b, line);
      values[static_cast<std::size_t>(b)].add(line);
      if (half_width == nullptr) continue;
      half_width->read(y, b, line);
      widths[static_cast<std::size_t>(b)].add(line);
    }

  std::vector<ChannelStatistics> result(bands);
  for (std::size_t b = 0; b < bands; ++b) {
    const Sums &v = values[b], &w = widths[b];
    ChannelStatistics& s = result[b];
    s.not_finite = v.total - v.finite;
    const double n = static_cast<double>(v.finite);
    s.minimum = v.finite > 0 ? v.low : kNone;
    s.maximum = v.finite > 0 ? v.high : kNone;
    s.mean = v.finite > 0 ? v.offset + v.sum / n : kNone;
    s.standard_deviation =
        v.finite > 0 ? std::sqrt(std::max(0.0, v.squares / n - v.sum / n * (v.sum / n))) : kNone;
    s.mean_half_width = w.finite > 0 ? w.offset + w.sum / static_cast<double>(w.finite) : kNone;
    s.largest_half_width = w.finite > 0 ? w.high : kNone;
  }
  return result;
}

}  // namespace ifov::io
