#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "core/run_control.h"

namespace ifov::session {

/// A token that is cancelled where a file appears (io::stop_file), or when the user's is. A file that was there before is from an
/// earlier run and is taken away, as is one that was heeded.
class StopRequest {
 public:
  /// Both may be missing.
  StopRequest(std::filesystem::path file, const CancelToken* user);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  const CancelToken* token() const { return &own_; }

 private:
  void watch();

  std::filesystem::path file_;
  CancelToken own_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool leaving_ = false;
  std::thread watcher_;
};

}  // namespace ifov::session
