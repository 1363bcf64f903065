#include "session/runs/time_limit.h"

namespace ifov::session {

TimeLimit::TimeLimit(std::optional<Clock::time_point> end, const CancelToken* user)
    : user_(user), own_(user) {
  if (end) watcher_ = std::thread([this, when = *end] { watch(when); });
}

TimeLimit::~TimeLimit() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  wake_.notify_one();
  if (watcher_.joinable()) watcher_.join();
}

bool TimeLimit::reached() const {
  const std::lock_guard lock(mutex_);
  return reached_;
}

void TimeLimit::watch(Clock::time_point end) {
  std::unique_lock lock(mutex_);
  while (!leaving_ && Clock::now() < end) wake_.wait_until(lock, end);
  reached_ = !leaving_ && (user_ == nullptr || !user_->cancelled());
  if (reached_) own_.cancel();
}

}  // namespace ifov::session
