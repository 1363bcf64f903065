#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace ifov::viewer {

struct OpenRun;
class RunWatch;

/// What one folder of the command line holds, now: nothing, a run at work or stopped, or products. Looks again when it is asked,
/// a few times a second at most. From any thread.
class Source {
 public:
  explicit Source(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Now {
    /// Rises by one whenever products are found anew: what was asked of others is not answered from these.
    std::uint64_t generation = 0;
    std::shared_ptr<const OpenRun> run;     ///< null: no products
    std::shared_ptr<const RunWatch> watch;  ///< null: no unfinished run
    std::string fault;  ///< why the folder shows nothing, or no longer what it did; empty: nothing to say
  };
  Now now();
  /// Gives back the products' files until it is asked again: it is then of the same generation, where they are the same.
  void close();
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void look();

  std::filesystem::path folder_;
  std::mutex mutex_;
  Now now_;
  std::string signature_;
  std::chrono::steady_clock::time_point next_look_{};
};

}  // namespace ifov::viewer
