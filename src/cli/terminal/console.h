#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/run_control.h"

namespace ifov::cli {

/// What a run says while it works: warnings and a progress bar on the terminal (standard error), everything
/// in a log file. The bar is drawn on terminals only, at most ten times a second, and with the time that passes at least
/// twice a second.
class Console final : public LogSink, public ProgressSink {
 public:
  /// `log_file` may be empty. Throws SystemError where it cannot be written.
  Console(bool quiet, const std::string& log_file);
  ~Console() override;

  void info(const std::string& message) override;
  void warn(const std::string& message) override;
  void report(const Progress& progress) override;

  void phase(const std::string& what) override;
  /// Takes the bar away, before other output.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void log(const char* level, const std::string& message);
  void draw();
  void keep_time();
  void erase_bar();

  std::mutex mutex_;
  std::ofstream log_;
  std::string what_;
  std::optional<Progress> progress_;  ///< the last that was reported of what is being worked on
  bool quiet_ = false, on_terminal_ = false, bar_shown_ = false, working_ = false, leaving_ = false;
  Clock::time_point start_, last_drawn_, last_logged_, reported_;
  std::condition_variable wake_;
  std::thread clock_;  ///< where there is a terminal
};

/// Throws InputError unless the count is 0 (--strict).
void require_no_warnings(std::size_t count);

}  // namespace ifov::cli
