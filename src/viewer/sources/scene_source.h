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

/// The scene of a document, loaded beside once somebody asks for it. From any thread.
class SceneSource {
 public:
  /// `set` as of Document::read.
  SceneSource(std::filesystem::path file, std::vector<std::string> set);
  /// Stops loading.
  ~SceneSource();
  SceneSource(const SceneSource&) = delete;
  SceneSource& operator=(const SceneSource&) = delete;

  struct State {
    std::shared_ptr<const session::SceneModel> model;  ///< null: not yet, or never
    std::string failure;                               ///< why there is none; empty: it is being loaded
    std::vector<session::DocumentFault> faults;  ///< without a model: those that came before the failure
    std::string phase;                           ///< of loading: what it is at
    std::int64_t done = 0, of = 0;               ///< objects of the document
    double elapsed_s = 0.0;                      ///< of loading, so far or at all
  };
  /// Begins to load where nobody has asked before.
  State state();
  /// Whether it has begun to load, and goes on.
  bool is_loading();

  std::string file() const { return file_.string(); }

  /// Rays that were traced for pictures and picks since the program began.
  std::atomic<std::int64_t> rays{0};

 private:
  class Teller;
  void load();

  std::filesystem::path file_;
  std::vector<std::string> set_;
  CancelToken cancel_;
  std::mutex mutex_;
  State state_;
  std::chrono::steady_clock::time_point begun_;
  std::thread loading_;
};

}  // namespace ifov::viewer
