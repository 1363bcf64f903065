#include "render/tile_loop.h"

#include <algorithm>

#include "core/parallel.h"
#include "sampling/tile.h"

namespace ifov::render {

Tally::Tally(std::int64_t pixels, ProgressSink* sink)
    : sink_(sink), start_(std::chrono::steady_clock::now()) {
  total_.pixels_total = pixels;
}

void Tally::add(const sampling::TileResult& tile) {
  const std::scoped_lock lock(mutex_);
  total_.pixels_done += tile.tile.count();
  total_.pixels_converged += tile.converged_count();
  total_.rays += static_cast<std::int64_t>(tile.rays.total());
  for (float ratio : tile.worst_ratio)
    total_.worst_error_ratio = std::max(total_.worst_error_ratio, static_cast<double>(ratio));
  total_.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (sink_ != nullptr) sink_->report(total_);
}

void Tally::add(const sampling::RayCounts& rays) { total_.rays += static_cast<std::int64_t>(rays.total()); }

std::optional<int> TilesInOrder::next() {
  const std::size_t index = taken_++;
  if (index >= count_) return std::nullopt;
  return order_.empty() ? static_cast<int>(index) : order_[index];
}

void render_from(TileSource& source, int threads, const std::function<void(std::size_t)>& render_tile) {
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
