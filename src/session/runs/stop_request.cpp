#include "session/runs/stop_request.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace ifov::session {
namespace {

constexpr auto kEvery = std::chrono::milliseconds(300);  // the disk may be another machine's

}  // namespace

StopRequest::StopRequest(std::filesystem::path file, const CancelToken* user)
    : file_(std::move(file)), own_(user) {
  if (file_.empty()) return;
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
  while (!leaving_ && !own_.cancelled()) {
    wake_.wait_for(lock, kEvery);
    std::error_code ignored;
    if (std::filesystem::exists(file_, ignored)) own_.cancel();
  }
}

}  // namespace ifov::session
