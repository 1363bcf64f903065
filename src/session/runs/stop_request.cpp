#include "session/runs/stop_request.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace ifov::session {
namespace {

constexpr auto kUserEvery = std::chrono::milliseconds(20);
constexpr int kFileEvery = 15;  // of those looks: the disk may be another machine's

}  // namespace

StopRequest::StopRequest(std::filesystem::path file, const CancelToken* user)
    : file_(std::move(file)), user_(user) {
  if (file_.empty()) return;
  if (user_ != nullptr && user_->cancelled()) own_.cancel();  // at once, not at the first look
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  watcher_ = std::thread([this] { watch(); });
}

StopRequest::~StopRequest() {
  if (!watcher_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  wake_.notify_one();
  watcher_.join();
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

void StopRequest::watch() {
  std::unique_lock lock(mutex_);
  for (int look = 1; !leaving_ && !own_.cancelled(); ++look) {
    std::error_code ignored;
    const bool stopped = (user_ != nullptr && user_->cancelled()) ||
                         (look % kFileEvery == 0 && std::filesystem::exists(file_, ignored));
    if (stopped)
      own_.cancel();
    else
      wake_.wait_for(lock, kUserEvery);
  }
}

}  // namespace ifov::session
