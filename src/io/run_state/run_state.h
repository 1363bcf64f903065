#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "core/run_start.h"
#include "io/run_state/run_lock.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/tile_index.h"
#include "io/run_state/tile_store.h"
#include "io/run_state/tile_survey.h"

namespace ifov::io {

/// The state of an unfinished run, in the folder `run.part` of its output folder: plan, lock and finished
/// tiles. One process at a time.
class RunState {
 public:
  /// Takes the lock. Throws InputError where the folder holds a run that is not to be thrown away, or that
  /// differs from `plan`; SystemError where another process is at work in it, and for files.
  RunState(const std::filesystem::path& folder, const RunPlan& plan, RunStart start, LogSink* log);

  /// Where means and half-widths of finished tiles lie besides: what the state holds of them goes once the cubes hold it.
  struct Cubes {
    ReadValues read_values;
    std::function<int()>
        lines_written;  ///< image lines [0, n) are in the cubes; empty: the state goes on holding all
  };
  /// Before read().
  void use(Cubes cubes) { cubes_ = std::move(cubes); }

  /// Each finished tile goes to `take`, in no particular order, each once. Damaged tiles are told to the log
  /// and removed. Comes before the first put().
  TilesDone read(const std::function<void(const sampling::TileResult&)>& take);

  /// A tile that read() has met or a rank's packs hold, from any thread; false where it is damaged, which the log is
  /// told.
  bool read_tile(std::size_t index, sampling::TileResult& tile) const;

  /// Where several processes work on the run: what the others' stores are made with, after read().
  const StoreStart& store_start() const { return store_->start(); }
  /// The packs that a rank has written since, by their headers.
  TilesDone find(int rank, int packs);

  /// From any thread.
  void put(std::uint32_t index, const sampling::TileResult& tile);
  /// Returns when all tiles are on disk, in how many packs of this process; no put() follows.
  int close();
  /// Takes the folder away, and what an earlier run has kept.
  void remove();
  /// Leaves the tiles in kept_folder(), to be refined, in place of those of an earlier run.
  void keep();

  /// As of the first start: the name of the document, for one, is the one given then.
  const RunPlan& plan() const { return plan_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  /// A pack that holds values, and the line that follows its last one.
  struct HeldPack {
    std::filesystem::path path;
    int line_end = 0;
  };
  void move_values_out(const std::filesystem::path& pack, int line_end);

  RunPlan plan_;
  LogSink* log_;
  std::filesystem::path path_;
  std::unique_ptr<RunLock> lock_;
  TileIndex index_;
  Cubes cubes_;
  std::vector<HeldPack> held_;        ///< of read() and the store's thread
  std::unique_ptr<TileStore> store_;  ///< the last member: its thread ends before what it uses does
};

/// Whether the folder holds a complete run: a run record of any name.
bool holds_complete_run(const std::filesystem::path& folder);

/// About what a run's products take on disk; the picture and the report, which are small, are left out.
struct ProductBytes {
  std::uint64_t cached = 0;  ///< that go through the page cache, and from there to the disk at the end
  std::uint64_t direct = 0;  ///< of large cubes
  std::uint64_t all() const { return cached + direct; }
};
ProductBytes product_bytes(const RunPlan& plan);

/// What an unfinished run has taken of the disk in its output folder: kept tiles, and products not yet published.
std::uint64_t leftover_bytes(const std::filesystem::path& folder);

/// Bytes that the state of a run takes at most, about: how many materials share a pixel is not known before. One process
/// that makes the cubes too leaves the values to them.
std::uint64_t state_bytes(const RunPlan& plan, bool one_process);

}  // namespace ifov::io
