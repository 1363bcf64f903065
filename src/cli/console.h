#pragma once

#include <chrono>
#include <fstream>
#include <mutex>
#include <string>

#include "core/run_control.h"

namespace ifov::cli {

/// What a run says while it works: warnings and a progress bar on the terminal (standard error), everything
/// in a log file. The bar is drawn on terminals only, at most ten times a second.
class Console final : public LogSink, public ProgressSink {
 public:
  /// `log_file` may be empty. Throws EnvironmentError where it cannot be written.
  Console(bool quiet, const std::string& log_file);
  ~Console() override;

  void info(const std::string& message) override;
  void warn(const std::string& message) override;
  void report(const Progress& progress) override;

  /// What is being worked on from now, in front of its progress; empty for the run itself.
  void begin(const std::string& what);
  /// Takes the bar away, before other output.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void log(const char* level, const std::string& message);
  std::string line_of(const Progress& progress) const;
  void erase_bar();

  std::mutex mutex_;
  std::ofstream log_;
  std::string what_;
  bool quiet_ = false, on_terminal_ = false, bar_shown_ = false;
  Clock::time_point start_, last_drawn_, last_logged_;
};

}  // namespace ifov::cli
