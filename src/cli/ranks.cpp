#include "cli/ranks.h"

#include <chrono>

#include "cli/terminal/say.h"

namespace ifov::cli {
namespace {

std::unique_ptr<Ranks>& joined() {
  static std::unique_ptr<Ranks> ranks;
  return ranks;
}

}  // namespace

Ranks* join_ranks() {
  if (!joined()) joined() = Ranks::join();
  return joined().get();
}

StopNotice::StopNotice(const CancelToken& token, std::string message)
    : thread_([this, &token, words = std::move(message)] { watch(token, words); }) {}

StopNotice::~StopNotice() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void StopNotice::watch(const CancelToken& token, const std::string& message) {
  std::unique_lock lock(mutex_);
  while (!leaving_ && !token.cancelled()) wake_.wait_for(lock, std::chrono::milliseconds(20));
  if (token.cancelled()) complain(message);
}

void leave_ranks() { joined().reset(); }

}  // namespace ifov::cli
