#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "core/run_control.h"

namespace ifov::session {

/// A token that is cancelled at a time, or when the user's is.
class TimeLimit {
 public:
  using Clock = std::chrono::steady_clock;
  /// Both may be missing.
  TimeLimit(std::optional<Clock::time_point> end, const CancelToken* user);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  const CancelToken* token() const { return &own_; }
  /// Time was up, and the user had not stopped the run.
  bool reached() const;

 private:
  void watch(Clock::time_point end);

  const CancelToken* user_;
  CancelToken own_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool leaving_ = false, reached_ = false;
  std::thread watcher_;
};

}  // namespace ifov::session
