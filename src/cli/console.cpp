#include "cli/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "cli/progress_line.h"
#include "core/error.h"
#include "core/format.h"

namespace ifov::cli {
namespace {

constexpr auto kDrawEvery = std::chrono::milliseconds(100);
constexpr auto kLogEvery = std::chrono::seconds(10);
constexpr int kUsualWidth = 80;
constexpr int kLogWidth = 200;

int terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1 : kUsualWidth - 1;
}

}  // namespace

Console::Console(bool quiet, const std::string& log_file)
    : quiet_(quiet), on_terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_logged_(start_) {
  if (log_file.empty()) return;
  log_.open(log_file, std::ios::trunc);
  if (!log_) throw EnvironmentError(format("cannot write the log '{}': {}", log_file, std::strerror(errno)));
}

Console::~Console() { finish(); }

void Console::info(const std::string& message) {
  const std::lock_guard lock(mutex_);
  log("info", message);
}

void Console::warn(const std::string& message) {
  const std::lock_guard lock(mutex_);
  log("warning", message);
  if (quiet_) return;
  erase_bar();
  std::fprintf(stderr, "ifov: warning: %s\n", message.c_str());
}

void Console::report(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool last = progress.pixels_done >= progress.pixels_total;
  if (log_.is_open() && (last || now - last_logged_ >= kLogEvery)) {
    log("progress", what_ + progress_line(progress, kLogWidth));
    last_logged_ = now;
  }
  if (quiet_ || !on_terminal_ || (bar_shown_ && !last && now - last_drawn_ < kDrawEvery)) return;
  std::fprintf(stderr, "\r\x1b[K%s", line_of(progress).c_str());
  std::fflush(stderr);
  bar_shown_ = true;
  last_drawn_ = now;
}

std::string Console::line_of(const Progress& progress) const {
  const int width = terminal_width(), left = width - static_cast<int>(what_.size());
  return left > 0 ? what_ + progress_line(progress, left) : progress_line(progress, width);
}

void Console::begin(const std::string& what) {
  const std::lock_guard lock(mutex_);
  erase_bar();
  what_ = what.empty() ? what : what + "  ";
}

void Console::finish() {
  const std::lock_guard lock(mutex_);
  erase_bar();
}

void Console::log(const char* level, const std::string& message) {
  if (!log_.is_open()) return;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  log_ << format("{:9.3f} s  {}: {}\n", elapsed_s, level, message) << std::flush;
}

void Console::erase_bar() {
  if (!bar_shown_) return;
  std::fprintf(stderr, "\r\x1b[K");
  std::fflush(stderr);
  bar_shown_ = false;
}

}  // namespace ifov::cli
