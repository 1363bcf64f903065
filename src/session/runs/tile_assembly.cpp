#include "session/runs/tile_assembly.h"

#include <utility>

#include "core/parallel.h"
#include "io/run_state/run_plan.h"
#include "session/runs/run_products.h"

namespace ifov::session {

TileAssembly::TileAssembly(const io::RunPlan& plan, std::vector<bool> kept, Read read, RunProducts* products)
    : plan_(plan),
      kept_(std::move(kept)),
      read_(std::move(read)),
      products_(products),
      grid_(plan.grid()),
      written_(grid_.size()) {}

bool TileAssembly::take(std::size_t index) {
  sampling::TileResult tile;
  if (!read_(index, tile)) return false;
  write(index, tile);
  return true;
}

std::optional<int> TileAssembly::next() {
  for (std::size_t index; (index = next_++) < grid_.size();) {
    if (kept_[index] && (products_ == nullptr || take(index))) continue;
    if (plan_.share.has(index)) return static_cast<int>(index);
  }
  return std::nullopt;
}

void TileAssembly::write(std::size_t index, const sampling::TileResult& tile) {
  if (products_ == nullptr) return;
  products_->write(tile);
  written_[index] = 1;
}

std::size_t TileAssembly::finish(std::vector<bool> kept, int threads, sampling::Reason reason) {
  kept_ = std::move(kept);
  std::atomic<std::size_t> taken{0}, unread{0};
  std::atomic<bool> failed{false};
  const int workers = threads > 0 ? threads : usual_threads();
  parallel_for(workers, threads, [&](std::int64_t) {
    try {
      for (std::size_t index; !failed && (index = taken++) < grid_.size();) {
        if (written_[index] != 0 || (kept_[index] && take(index))) continue;
        if (kept_[index]) ++unread;
        products_->write_missing(grid_[index], reason);
      }
    } catch (...) {
      failed = true;
      throw;
    }
  });
  return unread;
}

}  // namespace ifov::session
