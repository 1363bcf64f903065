#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>

#include "core/parallel.h"
#include "core/run_control.h"
#include "render/tile_source.h"
#include "sampling/tile.h"

namespace ifov::render {

/// Adds up finished tiles for the progress display and the totals.
class Tally {
 public:
  Tally(std::int64_t pixels, ProgressSink* sink) : sink_(sink), start_(std::chrono::steady_clock::now()) {
    total_.pixels_total = pixels;
  }
  void add(const sampling::TileResult& tile) {
    const std::scoped_lock lock(mutex_);
    total_.pixels_done += tile.tile.count();
    total_.pixels_converged += tile.converged_count();
    total_.rays += static_cast<std::int64_t>(tile.rays.total());
    for (float ratio : tile.worst_ratio)
      total_.worst_error_ratio = std::max(total_.worst_error_ratio, static_cast<double>(ratio));
    total_.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (sink_ != nullptr) sink_->report(total_);
  }
  void add(const sampling::RayCounts& rays) {
    const std::scoped_lock lock(mutex_);
    total_.rays += static_cast<std::int64_t>(rays.total());
  }
  const Progress& total() const { return total_; }

 private:
  ProgressSink* sink_;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  Progress total_;
};

/// Of the tiles of a grid that are wanted; of all where no order is given.
inline std::int64_t pixels_of(std::span<const int> order, std::span<const sampling::PixelRect> tiles) {
  std::int64_t pixels = 0;
  for (const int index : order) pixels += tiles[static_cast<std::size_t>(index)].count();
  if (order.empty())
    for (const sampling::PixelRect& tile : tiles) pixels += tile.count();
  return pixels;
}

/// One after the other, so that lines of the image become whole in the order of the file.
class TilesInOrder final : public TileSource {
 public:
  /// `order` may be empty: all `count` tiles.
  TilesInOrder(std::span<const int> order, std::size_t count)
      : order_(order), count_(order.empty() ? count : order.size()) {}
  std::optional<int> next() override {
    const std::size_t index = taken_++;
    if (index >= count_) return std::nullopt;
    return order_.empty() ? static_cast<int>(index) : order_[index];
  }

 private:
  std::span<const int> order_;
  std::size_t count_;
  std::atomic<std::size_t> taken_{0};
};

/// Each thread takes tiles until there are no more; what one of them throws ends them all.
inline void render_from(TileSource& source, int threads,
                        const std::function<void(std::size_t)>& render_tile) {
  const int workers = threads > 0 ? threads : usual_threads();
  std::atomic<bool> failed{false};
  parallel_for(workers, threads, [&](std::int64_t) {
    try {
      while (!failed)
        if (const std::optional<int> tile = source.next())
          render_tile(static_cast<std::size_t>(*tile));
        else
          return;
    } catch (...) {
      failed = true;
      throw;
    }
  });
}

}  // namespace ifov::render
