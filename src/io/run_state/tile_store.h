#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "io/run_state/tile_record.h"

namespace ifov::io {

inline constexpr const char* kPackEnding = ".tiles";

/// One start of a run, which may be at work in several processes: its mark, which tells the starts of a run apart, and
/// the number of the first pack that it writes.
struct StoreStart {
  std::uint64_t mark = 0;
  int first_pack = 0;
};

/// "000012.tiles" of the run's first process; those of other ranks are named after the start and the rank too:
/// "000012.18a9.3.tiles".
std::string pack_name(const StoreStart& start, int rank, int number);

/// Keeps finished tiles in files, each written beside its name and renamed when whole. Tiles that are
/// finished within a short time share a file, a pack, so that cheap tiles do not drown in files: at first a
/// thousandth of a second, later a twentieth of what the run has taken, at most a second. After many they go
/// past the page cache. A thread of its own writes; errors in it (a full disk) are thrown by the next put() or
/// close() as SystemError.
class TileStore {
 public:
  /// `run` is RunPlan::key(). Makes the folder.
  TileStore(std::filesystem::path folder, std::uint64_t run);
  /// The store of another rank of the same start.
  TileStore(std::filesystem::path folder, std::uint64_t run, const StoreStart& start, int rank);
  /// Writes what waits; errors are lost, call close() to see them.
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// Called by the writing thread after each pack, with its file and the line that follows its last one; before the first
  /// put().
  using Written = std::function<void(const std::filesystem::path& pack, int line_end)>;
  void when_written(Written written) { written_ = std::move(written); }

  /// From any thread; waits where far more is put than the disk takes.
  void put(std::uint32_t index, const sampling::TileResult& tile);

  /// Returns when all is on disk. No put() may be under way or follow.
  void close();

  const StoreStart& start() const { return start_; }
  /// How many have been written; after close().
  int packs() const { return packs_; }

 private:
  using Record = std::vector<std::byte>;
  struct Waiting {
    Record record;
    int line_end;
  };
  double elapsed_s() const;
  void work();
  void write_pack(const std::vector<Waiting>& tiles);

  std::filesystem::path folder_;
  std::uint64_t run_;
  StoreStart start_;
  int rank_ = 0, packs_ = 0;
  std::chrono::steady_clock::time_point began_;
  std::mutex mutex_;
  std::condition_variable wake_, room_;
  std::vector<Waiting> waiting_;
  Written written_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t written_bytes_ = 0;
  bool closing_ = false;
  std::exception_ptr failure_;
  std::thread writer_;
};

}  // namespace ifov::io
