#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "ifov/api.h"

namespace ifov {

/// Asked between batches of rays by everything that takes long; may be set from any thread and from a signal
/// handler.
class CancelToken {
 public:
  /// Is cancelled with `other`, too, which must outlive it.
  explicit CancelToken(const CancelToken* other = nullptr) noexcept : other_(other) {}
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const noexcept {
    return cancelled_.load(std::memory_order_relaxed) || (other_ != nullptr && other_->cancelled());
  }

 private:
  const CancelToken* other_ = nullptr;
  std::atomic<bool> cancelled_{false};
};

/// Libraries never print: what they have to say goes here. Calls may come from several threads.
class IFOV_API LogSink {
 public:
  virtual ~LogSink() = default;
  virtual void info(const std::string& message) = 0;
  virtual void warn(const std::string& message) = 0;
};

/// State of a running render, reported after each finished tile.
struct Progress {
  std::int64_t pixels_done = 0;
  std::int64_t pixels_total = 0;
  std::int64_t pixels_converged = 0;
  std::int64_t rays = 0;  ///< all rays traced so far, of every kind
  /// Largest half-width so far in units of its limit; 0 where no accuracy is asked.
  double worst_error_ratio = 0.0;
  double elapsed_s = 0.0;
};

class IFOV_API ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  virtual void report(const Progress& progress) = 0;
  /// What is being worked on from now: "reading the scene"; empty: the image itself.
  virtual void phase(const std::string& what) { static_cast<void>(what); }
};

/// What to do where a folder holds the finished tiles of a run.
enum class RunStart {
  fresh,    ///< refuse: nothing finished is thrown away unasked
  resume,   ///< go on with it; where there is none, begin
  restart,  ///< throw it away and begin
};

}  // namespace ifov
