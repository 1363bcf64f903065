#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "io/envi/envi_header.h"
#include "io/product_parts/run_record.h"
#include "io/product_parts/sha256.h"

namespace ifov::io {

/// Figures of one band; values that are not finite are counted and left away.
class BandFigures {
 public:
  /// One line. Sums are over eight fixed lanes, so that they do not depend on the instruction set.
  void add(std::span<const float> values);

  std::uint64_t finite() const { return finite_; }
  std::uint64_t not_finite() const { return total_ - finite_; }
  /// Not a number where no value is finite.
  double minimum() const;
  double maximum() const;
  double mean() const;
  double standard_deviation() const;

 private:
  void add_finite(std::span<const float> values);

  double offset_ = 0.0, sum_ = 0.0, squares_ = 0.0;  // about the first finite value
  float low_ = std::numeric_limits<float>::infinity(), high_ = -low_;
  std::uint64_t finite_ = 0, total_ = 0;
};

/// What is told of a cube, found as its lines pass from the first to the last: the SHA-256 and figures of bands. It does
/// not depend on the order in which tiles came.
class CubeScan {
 public:
  /// The checksum is of what passes, unless the file holds its lines band by band: then of what add_bytes() is given.
  CubeScan(int width, int bands, std::size_t value_bytes = 4, EnviInterleave interleave = EnviInterleave::bil)
      : width_(width), bands_(bands), value_bytes_(value_bytes), interleave_(interleave) {}

  /// Before the first line: figures are wanted too, of values that are floats.
  void want_figures() { figures_.resize(static_cast<std::size_t>(bands_)); }

  /// The next line: `bands` rows of `width` values, `stride_bytes` apart; by pixel `width` values of `bands`, without gaps.
  void take(const std::byte* line, std::size_t stride_bytes);
  /// Of a band-sequential file, from its first byte on.
  void add_bytes(std::span<const std::byte> bytes) { sum_.update(bytes.data(), bytes.size()); }
  int lines() const { return lines_; }

  /// Of all lines that were taken; call once.
  std::string checksum() { return sum_.digest(); }
  const std::vector<BandFigures>& figures() const { return figures_; }

 private:
  int width_, bands_, lines_ = 0;
  std::size_t value_bytes_;
  EnviInterleave interleave_;
  std::vector<std::byte> turned_;  // of a line by pixel
  Sha256 sum_;
  std::vector<BandFigures> figures_;
};

/// `half_width`, of intervals of this confidence, may be null: its figures are then not a number.
std::vector<ChannelStatistics> channel_statistics(const render::ImageInfo& image, const CubeScan& radiance,
                                                  const CubeScan* half_width, double confidence);

}  // namespace ifov::io
