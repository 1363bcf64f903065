#include "cli/terminal/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "cli/terminal/progress_line.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "core/printable.h"

namespace ifov::cli {
namespace {

constexpr auto kDrawEvery = std::chrono::milliseconds(100);
constexpr auto kTick = std::chrono::milliseconds(500);
constexpr auto kLogEvery = std::chrono::seconds(10);
constexpr int kUsualWidth = 80;
constexpr int kLogWidth = 200;

int terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1 : kUsualWidth - 1;
}

/// A link of this name may have come with somebody's scene. Those of the system lead to the terminal and to pipes.
void refuse_linked_log(const std::string& file) {
  std::error_code unknown;
  if (file.starts_with("/dev/") || file.starts_with("/proc/")) return;
  if (std::filesystem::is_symlink(file, unknown))
    throw SystemError(format("cannot write the log '{}': it is a link to '{}'; name that file, or another",
                             file, std::filesystem::read_symlink(file, unknown).string()));
}

}  // namespace

Console::Console(bool quiet, const std::string& log_file)
    : quiet_(quiet),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_logged_(start_),
      reported_(start_) {
  if (!quiet_ && on_terminal_) clock_ = std::thread([this] { keep_time(); });
  if (log_file.empty()) return;
  refuse_linked_log(log_file);
  log_.open(log_file, std::ios::trunc);
  if (!log_) throw SystemError(format("cannot write the log '{}': {}", log_file, std::strerror(errno)));
}

Console::~Console() {
  finish();
  if (!clock_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  wake_.notify_all();
  clock_.join();
}

void Console::info(const std::string& message) {
  const std::lock_guard lock(mutex_);
  log("info", message);
}

void Console::warn(const std::string& message) {
  const std::lock_guard lock(mutex_);
  log("warning", message);
  if (quiet_) return;
  erase_bar();
  complain(format("ifov: warning: {}", message));
}

void Console::report(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool last = progress.pixels_done >= progress.pixels_total;
  if (log_.is_open() && (last || now - last_logged_ >= kLogEvery)) {
    log("progress", (what_.empty() ? what_ : what_ + "  ") + progress_line(progress, kLogWidth));
    last_logged_ = now;
  }
  progress_ = progress, reported_ = now, working_ = true;
  if (quiet_ || !on_terminal_ || (bar_shown_ && !last && now - last_drawn_ < kDrawEvery)) return;
  draw();
}

void Console::draw() {
  const Clock::time_point now = Clock::now();
  const int width = terminal_width();
  const std::string what = what_.empty() ? what_ : what_ + "  ";
  std::string line;
  // What is done but for the rest that nobody counts is shown as time that passes.
  if (progress_ && progress_->pixels_done < progress_->pixels_total) {
    Progress shown = *progress_;
    shown.elapsed_s += std::chrono::duration<double>(now - reported_).count();
    const int left = width - static_cast<int>(what.size());
    line = left > 0 ? what + progress_line(shown, left) : progress_line(shown, width);
  } else {
    line = format("{}{:.0f} s", what, std::chrono::duration<double>(now - start_).count());
  }
  std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
  std::fflush(stderr);
  bar_shown_ = true;
  last_drawn_ = now;
}

void Console::keep_time() {
  std::unique_lock lock(mutex_);
  while (!leaving_) {
    wake_.wait_for(lock, kTick);
    if (!leaving_ && working_ && Clock::now() - last_drawn_ >= kTick) draw();
  }
}

void Console::phase(const std::string& what) {
  const std::lock_guard lock(mutex_);
  erase_bar();
  what_ = what;
  progress_.reset();
  working_ = true;
}

void Console::finish() {
  const std::lock_guard lock(mutex_);
  erase_bar();
  working_ = false;
}

void Console::log(const char* level, const std::string& message) {
  if (!log_.is_open()) return;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  log_ << format("{:9.3f} s  {}: {}\n", elapsed_s, level, printable_message(message)) << std::flush;
}

void Console::erase_bar() {
  if (!bar_shown_) return;
  std::fprintf(stderr, "\r\x1b[K");
  std::fflush(stderr);
  bar_shown_ = false;
}

void require_no_warnings(std::size_t count) {
  if (count > 0)
    throw InputError(format("ifov: {} warning{}, which --strict makes {}; nothing was done", count,
                            count == 1 ? "" : "s", count == 1 ? "an error" : "errors"));
}

}  // namespace ifov::cli
