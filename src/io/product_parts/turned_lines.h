#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace ifov::io {

/// The lines of a band-interleaved-by-pixel cube for those who look at it band by band: a whole line is read once, its bands are laid
/// side by side, and some of the lines that were looked at last are kept.
class TurnedLines {
 public:
  using ReadAt = std::function<void(std::uint64_t offset, void* to, std::size_t bytes)>;
  using Line = std::shared_ptr<const std::vector<std::byte>>;

  /// `read_at` reads the cube's file from its first value on; values have 1, 2, 4 or 8 bytes. At least `least_lines` are kept, and more
  /// while they take no more than `bytes`.
  TurnedLines(int samples, int bands, std::size_t value_bytes, ReadAt read_at, std::size_t bytes,
              std::size_t least_lines = 1);

  /// [band][sample]. From any thread; what `read_at` throws.
  Line line(int line) const;

 private:
  struct Kept {
    Line line;
    std::uint64_t looked_at = 0;
  };
  std::size_t samples_, bands_, value_bytes_;
  ReadAt read_at_;
  std::size_t most_lines_;
  mutable std::mutex mutex_;
  mutable std::map<int, Kept> kept_;
  mutable std::uint64_t looks_ = 0;
};

}  // namespace ifov::io
