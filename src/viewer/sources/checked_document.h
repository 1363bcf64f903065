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

/// A document as its file is now, and what `ifov check` says of it, which is found out beside once that is wanted: it loads all that
/// the document names. From any thread.
class CheckedDocument {
 public:
  /// `set` as of Document::read. Throws as readers do where the file cannot be read.
  CheckedDocument(const std::filesystem::path& file, const std::vector<std::string>& set);
  /// Stops the checks.
  ~CheckedDocument();
  CheckedDocument(const CheckedDocument&) = delete;
  CheckedDocument& operator=(const CheckedDocument&) = delete;

  struct State {
    std::uint64_t version = 1;  ///< rises by one whenever the file was found changed
    std::string file, text;
    bool checked = false;
    std::vector<Message> messages;
  };
  State state() const;
  /// Looks at the file, a few times a second at most: checks of what it held before end. Which version it holds.
  std::uint64_t look();
  /// Begins the checks where they have not begun.
  void begin();
  /// Where its products go, as the file was at the beginning; empty where that cannot be told.
  std::filesystem::path output_folder() const { return output_folder_; }

 private:
  std::filesystem::path file_;
  std::vector<std::string> set_;
  Call call_;
  std::filesystem::path output_folder_;

  mutable std::mutex mutex_;
  State state_;
  std::string signature_;
  std::chrono::steady_clock::time_point looked_{};
  std::shared_ptr<CancelToken>
      cancel_;  ///< of the checks that go on or have ended; null: none have begun of this version
  std::thread checks_;
};

}  // namespace ifov::viewer
