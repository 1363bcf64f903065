#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
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

/// Tiles from the counter on the first rank. A thread of its own asks for more while the last ones are being rendered.
class TileClient final : public render::TileSource, public ProgressSink {
 public:
  /// `user` may be null.
  TileClient(Communicator& communicator, int threads, const CancelToken* user);
  ~TileClient() override;
  TileClient(const TileClient&) = delete;
  TileClient& operator=(const TileClient&) = delete;

  std::optional<int> next() override;

  /// Goes to the first rank with the next message.
  void report(const Progress& progress) override;

  /// Cancelled by the user or by the first rank.
  const CancelToken* token() const { return &token_; }
  /// The first rank stopped the run: nothing more is to be said to it.
  bool was_stopped() const;

  /// Tells the first rank that this one is done.
  void farewell(const Fault& fault, int packs, const std::vector<std::string>& warnings);

 private:
  using Clock = std::chrono::steady_clock;
  void work();
  bool wants_more() const;
  void take(Message message);
  void ask(int idle);

  Communicator& communicator_;
  int threads_;
  const CancelToken* user_;
  CancelToken token_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<int> tiles_;
  struct Begun {
    int tile = 0;
    Clock::time_point when;
  };
  std::map<std::thread::id, Begun> begun_;
  std::vector<TileCost> finished_;  ///< not yet told
  Progress progress_;
  int idle_ = 0;
  std::size_t low_water_ = 0;  ///< more is asked for when no more than this is left
  bool asked_ = false, only_when_idle_ = false, no_more_ = false, stopped_ = false, leaving_ = false;
  Clock::time_point told_;
  std::thread thread_;
};

}  // namespace ifov::cluster
