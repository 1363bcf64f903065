#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "cluster/communicator.h"
#include "cluster/fault.h"
#include "cluster/tile_schedule.h"
#include "core/run_control.h"
#include "render/tile_source.h"

namespace ifov::cluster {

/// How a rank ended its part.
struct FinalReport {
  Fault fault;
  int packs = 0;  ///< files of tiles that it has written
  std::vector<std::string> warnings;
};

/// The counter of tiles, on the first rank: a thread of its own answers the others while the rest of the rank traces
/// what next() gives it.
class TileServer final : public render::TileSource {
 public:
  /// `user` may be null.
  TileServer(Communicator& communicator, TileSchedule schedule, const CancelToken* user);
  /// Stops the others where finish() was not called.
  ~TileServer() override;
  TileServer(const TileServer&) = delete;
  TileServer& operator=(const TileServer&) = delete;

  std::optional<int> next() override;

  /// Cancelled by the user or because a rank cannot go on.
  const CancelToken* token() const { return &token_; }

  /// What the other ranks have done so far.
  Progress others() const;

  /// After this rank's own tiles: waits until all others have put theirs on disk, and calls `wait` now and then. Throws
  /// what keeps a rank from it; Cancelled where the user stopped the run.
  std::map<int, FinalReport> finish(const std::function<void()>& wait);

 private:
  void serve();
  void answer(Message message);
  void stop_all();
  bool all_gone() const;

  Communicator& communicator_;
  const CancelToken* user_;
  CancelToken token_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  TileSchedule schedule_;
  std::map<std::thread::id, TileCost> own_;  ///< tiles and when they were begun
  std::map<int, Progress> progress_;         ///< of the others
  std::map<int, FinalReport> final_reports_;
  std::optional<int> failed_;  ///< the first rank that could not go on
  bool stopped_ = false, leaving_ = false;
  std::thread thread_;
};

}  // namespace ifov::cluster
