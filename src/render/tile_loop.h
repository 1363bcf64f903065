#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <span>

#include "core/run_control.h"
#include "render/tile_source.h"

namespace ifov::sampling {
struct RayCounts;
struct TileResult;
}  // namespace ifov::sampling

namespace ifov::render {

/// Adds up finished tiles for the progress display and the totals.
class Tally {
 public:
  Tally(std::int64_t pixels, ProgressSink* sink);
  void add(const sampling::TileResult& tile);
  void add(const sampling::RayCounts& rays);
  const Progress& total() const { return total_; }

 private:
  ProgressSink* sink_;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  Progress total_;
};

/// One after the other, so that lines of the image become whole in the order of the file.
class TilesInOrder final : public TileSource {
 public:
  /// `order` may be empty: all `count` tiles.
  TilesInOrder(std::span<const int> order, std::size_t count)
      : order_(order), count_(order.empty() ? count : order.size()) {}
  std::optional<int> next() override;

 private:
  std::span<const int> order_;
  std::size_t count_;
  std::atomic<std::size_t> taken_{0};
};

/// Each thread takes tiles until there are no more; what one of them throws ends them all.
void render_from(TileSource& source, int threads, const std::function<void(std::size_t)>& render_tile);

}  // namespace ifov::render
