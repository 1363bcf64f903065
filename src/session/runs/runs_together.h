#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "session/runs/run.h"

namespace ifov::render {
struct ImageOfTime;
}
namespace ifov::scene {
class TemperaturesOfTimes;
}

namespace ifov::session {

struct Parts;

/// A run whose tiles somebody else traces: begun, then ended when these have come.
class OneRun {
 public:
  OneRun(const Session& session, const RunRequest& request);
  ~OneRun();

  /// What it throws says that what is finished is kept, where it is.
  void keeping(const std::function<void()>& action) const;
  void begin();
  render::ImageOfTime image();  ///< after begin()
  /// Where tracing is asked to end early, and what it leaves of a time limit.
  std::filesystem::path stop_file() const;
  std::chrono::steady_clock::duration time_for_products() const;
  RunResult end(double elapsed_s);

 private:
  struct Inside;
  std::unique_ptr<Inside> run_;
};

/// Why times cannot be rendered along the same paths, in words; empty: they can.
std::string cannot_run_together(std::span<const Parts* const> by_time);

/// One of several times that are rendered along the same paths.
struct RunOfTime {
  const Session* session;
  const RunRequest* request;  ///< null: it is done, and there for the others
};
struct RunTogether {
  int threads = 0;
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;  ///< phases; those of the requests are told of their tiles
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::size_t most_bytes = 0;  ///< by thread, of what they share
};

/// Errors as of render_run(). Of those that are done nothing comes back.
std::vector<RunResult> render_runs(std::span<const RunOfTime> runs,
                                   const scene::TemperaturesOfTimes& temperatures, const RunTogether& how);

}  // namespace ifov::session
