#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/call_scope.h"
#include "ifov/check.h"

namespace ifov::viewer {

struct OpenRun;
class RunWatch;

/// A document and what `ifov check` says of it, which is found out beside once that is wanted: it loads all that the document names.
class CheckedDocument {
 public:
  CheckedDocument(const std::filesystem::path& file, const std::vector<std::string>& set);
  /// Stops the checks.
  ~CheckedDocument();
  CheckedDocument(const CheckedDocument&) = delete;
  CheckedDocument& operator=(const CheckedDocument&) = delete;

  struct State {
    std::string file, text;
    bool checked = false;
    std::vector<Message> messages;
  };
  State state() const;
  /// Begins the checks where they have not begun.
  void begin();
  /// Where its products go; empty where that cannot be told.
  std::filesystem::path output_folder() const;

 private:
  CancelToken cancel_;
  mutable std::mutex mutex_;
  State state_;
  std::filesystem::path output_folder_;
  std::filesystem::path file_;
  std::vector<std::string> set_;
  Call call_;
  std::thread checks_;
};

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
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void look();

  std::filesystem::path folder_;
  std::mutex mutex_;
  Now now_;
  std::string signature_;
  std::chrono::steady_clock::time_point looked_{};
  bool has_looked_ = false;
};

}  // namespace ifov::viewer
