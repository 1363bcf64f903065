#pragma once

#include <filesystem>
#include <string>

#include "core/run_control.h"

namespace ifov::io {

/// Keeps two runs out of one folder: a file that names the process and its host, held for as long as this
/// lives. A lock whose process is gone from this host is taken over, which `log` is told. Throws
/// SystemError where another run holds it, or where it was left by another host, whose processes cannot
/// be seen from here.
class RunLock {
 public:
  RunLock(std::filesystem::path file, LogSink* log);
  /// Takes the file away.
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Who holds the lock, "process 4711 on node7"; empty where nobody on this host does, or where there is none.
std::string lock_holder(const std::filesystem::path& file);

}  // namespace ifov::io
