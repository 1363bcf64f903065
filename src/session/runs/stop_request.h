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
  /// `file` may be empty: then this is the user's token, which may be null, and no more.
  StopRequest(std::filesystem::path file, const CancelToken* user);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  const CancelToken* token() const { return watcher_.joinable() ? &own_ : user_; }

 private:
  void watch();

  std::filesystem::path file_;
  const CancelToken* user_;
  CancelToken own_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool leaving_ = false;
  std::thread watcher_;
};

}  // namespace ifov::session
