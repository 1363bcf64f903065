#include "session/runs/time_limit.h"

#include <algorithm>

namespace ifov::session {
namespace {

constexpr auto kCheckEvery = std::chrono::milliseconds(20);

}  // namespace

TimeLimit::TimeLimit(std::optional<Clock::time_point> end, const CancelToken* user) : user_(user) {
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
  while (!leaving_ && !own_.cancelled()) {
    const bool stopped = user_ != nullptr && user_->cancelled();
    reached_ = !stopped && Clock::now() >= end;
    if (stopped || reached_)
      own_.cancel();
    else
      wake_.wait_until(lock, std::min<Clock::time_point>(end, Clock::now() + kCheckEvery));
  }
}

}  // namespace ifov::session
