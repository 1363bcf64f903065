#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>

#include "core/run_control.h"

namespace ifov::studies {

/// Adds up many small images into one progress display. Safe from several threads.
class StudyProgress {
 public:
  StudyProgress(std::int64_t pixels_total, ProgressSink* sink)
      : sink_(sink), start_(std::chrono::steady_clock::now()) {
    state_.pixels_total = pixels_total;
  }

  void add(std::int64_t pixels, std::uint64_t rays) {
    const std::scoped_lock lock(mutex_);
    state_.pixels_done += pixels;
    state_.rays += static_cast<std::int64_t>(rays);
    state_.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (sink_ != nullptr) sink_->report(state_);
  }

 private:
  ProgressSink* sink_;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  Progress state_;
};

}  // namespace ifov::studies
