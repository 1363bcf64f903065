#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "cluster/tile_server.h"
#include "core/run_control.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/run_state.h"
#include "render/tile_grid.h"
#include "render/tile_sink.h"
#include "session/runs/tile_assembly.h"

namespace ifov::session {

/// Keeps finished tiles, hands them to the products, and notes which there are.
class KeepingSink final : public render::TileSink {
 public:
  KeepingSink(const io::RunPlan& plan, TileAssembly* assembly, io::RunState* state, io::TilesDone& tiles)
      : plan_(plan), assembly_(assembly), state_(state), tiles_(tiles) {}
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override {
    const std::size_t index = render::tile_index(tile.tile.x0, tile.tile.y0, plan_.image.width_px,
                                                 plan_.tile_px, plan_.image.sweep_lines);
    if (state_ != nullptr) state_->put(static_cast<std::uint32_t>(index), tile);
    if (assembly_ != nullptr) assembly_->write(index, tile);
    const std::scoped_lock lock(mutex_);
    tiles_.done[index] = true;
    sampling::add_reasons(tile.reasons, tiles_.reasons);
  }

 private:
  const io::RunPlan& plan_;
  TileAssembly* assembly_;
  io::RunState* state_;
  std::mutex mutex_;
  io::TilesDone& tiles_;
};

inline void add_work(Progress& sum, const Progress& work) {
  sum.pixels_done += work.pixels_done;
  sum.pixels_converged += work.pixels_converged;
  sum.rays += work.rays;
  sum.worst_error_ratio = std::max(sum.worst_error_ratio, work.worst_error_ratio);
}

/// Hands the progress on, counted from the first start of the run, with what other ranks do now; and keeps the last of
/// it without them for runs that end early.
class LastProgress final : public ProgressSink {
 public:
  LastProgress(const Progress& before, ProgressSink* next, const cluster::TileServer* coordinator)
      : before_(before),
        last_(before),
        next_(next),
        coordinator_(coordinator),
        begin_(std::chrono::steady_clock::now()) {}
  void report(const Progress& progress) override {
    const std::scoped_lock lock(mutex_);
    last_ = before_;
    add_work(last_, progress);
    check();
  }
  /// Where nothing new is known of this process.
  void report_others() {
    const std::scoped_lock lock(mutex_);
    check();
  }
  const Progress& last() const { return last_; }

 private:
  void check() {
    last_.elapsed_s =
        before_.elapsed_s + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (next_ == nullptr) return;
    Progress all = last_;
    if (coordinator_ != nullptr) add_work(all, coordinator_->others());
    next_->report(all);
  }

  std::mutex mutex_;
  Progress before_, last_;
  ProgressSink* next_;
  const cluster::TileServer* coordinator_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace ifov::session
