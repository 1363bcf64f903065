#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "ifov/runs.h"

namespace ifov::cli {

/// The ranks that this program was started as by mpirun and its like; null where it is alone. They stay joined until
/// leave_ranks().
Ranks* join_ranks();

/// Says that the run is being stopped as soon as the token is cancelled: a launcher that ends a run kills its ranks a
/// second later.
class StopNotice {
 public:
  StopNotice(const CancelToken& token, std::string message);
  ~StopNotice();
  StopNotice(const StopNotice&) = delete;
  StopNotice& operator=(const StopNotice&) = delete;

 private:
  void watch(const CancelToken& token, const std::string& message);

  std::mutex mutex_;
  std::condition_variable wake_;
  bool leaving_ = false;
  std::thread thread_;
};

/// At the end of the program, when all is said: MPI waits there for ranks that may be gone.
void leave_ranks();

}  // namespace ifov::cli
