#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/run_control.h"
#include "session/scene_model/scene_model.h"

namespace ifov::viewer {

/// The scene of a document, loaded beside once somebody asks for it, and anew once it is told of another version. From any thread.
class SceneSource {
 public:
  /// `set` as of Document::read.
  SceneSource(std::filesystem::path file, std::vector<std::string> set);
  /// Stops loading.
  ~SceneSource();
  SceneSource(const SceneSource&) = delete;
  SceneSource& operator=(const SceneSource&) = delete;

  struct State {
    std::uint64_t version = 1;                         ///< of the document
    std::shared_ptr<const session::SceneModel> model;  ///< null: not yet, or never
    std::string failure;                               ///< why there is none; empty: it is being loaded
    std::vector<session::DocumentFault> faults;  ///< without a model: those that came before the failure
    std::string phase;                           ///< of loading: what it is at
    std::int64_t done = 0, of = 0;               ///< objects of the document
    double elapsed_s = 0.0;                      ///< of loading, so far or at all
  };
  /// Begins to load where nobody has asked before.
  State state();
  /// Drops what it has of another version of the document (CheckedDocument::look), and stops loading it.
  void follow(std::uint64_t version);
  /// Whether it has begun to load, and goes on.
  bool is_loading();

  std::string file() const { return file_.string(); }

  /// Rays that were traced for pictures and picks since the program began.
  std::atomic<std::int64_t> rays{0};

 private:
  class Teller;
  void load(std::uint64_t version);

  std::filesystem::path file_;
  std::vector<std::string> set_;
  std::mutex mutex_;
  State state_;
  std::shared_ptr<CancelToken> cancel_;  ///< of loading; null: it has not begun of this version
  std::chrono::steady_clock::time_point begun_;
  std::thread loading_;
};

}  // namespace ifov::viewer
