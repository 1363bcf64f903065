#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/run_control.h"

namespace ifov::cli {

/// Work looks at its CancelToken between pieces, and some pieces take long (a tree of a million triangles, a wide PSF).
/// Where it has not stopped by itself in 0.4 s, this ends the process, which leaves time for the system to take its
/// memory back within the second that is promised, also on a busy machine. Nothing is lost by that: files bear their
/// names only when they are whole, and finished tiles are on disk.
class CancelWatchdog {
 public:
  using Clock = std::chrono::steady_clock;

  /// `message` is what is said then. The token must outlive this.
  CancelWatchdog(const CancelToken& cancel, std::string message);
  ~CancelWatchdog();
  CancelWatchdog(const CancelWatchdog&) = delete;
  CancelWatchdog& operator=(const CancelWatchdog&) = delete;

  /// Until over(), the process also ends at this moment, with ExitCode::unmet and `message`.
  void limit(Clock::time_point deadline, std::string message);
  void over();

 private:
  void watch();

  const CancelToken& cancel_;
  std::string message_, limit_message_;
  std::optional<Clock::time_point> deadline_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool leaving_ = false;
  std::thread thread_;
};

}  // namespace ifov::cli
