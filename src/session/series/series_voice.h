#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::session {

/// What is said of the times of a series: a warning once, however many times have it; all else.
class SeriesLog final : public LogSink {
 public:
  explicit SeriesLog(LogSink* next) : next_(next) {}
  void info(const std::string& message) override;
  void warn(const std::string& message) override;
  std::size_t warnings() const;  ///< so far, each once

 private:
  LogSink* next_;
  mutable std::mutex mutex_;
  std::set<std::string> warned_;
};

/// The progress of one time as a part of that of all.
class SeriesProgress final : public ProgressSink {
 public:
  SeriesProgress(ProgressSink* next, std::size_t times)
      : next_(next), times_(times), begin_(std::chrono::steady_clock::now()) {}

  /// The next time is reported from now, of this number (from 0) among all, after which so many more come.
  void time(std::size_t number, const std::string& name, std::size_t more);
  /// The same of several that are rendered together.
  void times(std::size_t first, std::size_t together, const std::string& name, std::size_t more);
  void report(const Progress& progress) override;
  void phase(const std::string& what) override;
  /// Of all times so far.
  const Progress& all() const { return shown_; }

 private:
  ProgressSink* next_;
  std::size_t times_, number_ = 0, together_ = 1, more_ = 0;
  std::chrono::steady_clock::time_point begin_;
  std::mutex mutex_;
  std::string name_;
  bool rendering_ = false;
  Progress before_, shown_;  ///< of the times before this one; with it
};

/// The progress of several runs at once, added up.
class SumOfProgress {
 public:
  explicit SumOfProgress(ProgressSink& to) : to_(to) {}
  std::unique_ptr<ProgressSink> part();

 private:
  class Part;
  ProgressSink& to_;
  std::mutex mutex_;
  std::vector<Progress> parts_;
};

}  // namespace ifov::session
