#include "cli/cancel_watchdog.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "cli/exit_code.h"

namespace ifov::cli {
namespace {

constexpr std::chrono::milliseconds kLook(20), kGrace(400);

[[noreturn]] void end(ExitCode code, const std::string& message) {
  std::fprintf(stderr, "\n%s\n", message.c_str());
  _exit(static_cast<int>(code));
}

}  // namespace

CancelWatchdog::CancelWatchdog(const CancelToken& cancel, std::string message)
    : cancel_(cancel), message_(std::move(message)), thread_([this] { watch(); }) {}

CancelWatchdog::~CancelWatchdog() {
  {
    const std::scoped_lock lock(mutex_);
    leaving_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void CancelWatchdog::limit(Clock::time_point deadline, std::string message) {
  const std::scoped_lock lock(mutex_);
  deadline_ = deadline, limit_message_ = std::move(message);
}

void CancelWatchdog::over() {
  const std::scoped_lock lock(mutex_);
  deadline_.reset();
}

void CancelWatchdog::watch() {
  std::optional<Clock::time_point> asked;
  std::unique_lock lock(mutex_);
  while (!leaving_) {
    const Clock::time_point now = Clock::now();
    if (cancel_.cancelled() && !asked) asked = now;
    if (asked && now - *asked > kGrace) end(ExitCode::stopped, message_);
    if (deadline_ && now >= *deadline_)
      end(ExitCode::unmet, limit_message_);  // nobody else looks at it until over()
    wake_.wait_for(lock, kLook);
  }
}

}  // namespace ifov::cli
