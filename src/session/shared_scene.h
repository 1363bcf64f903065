#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "session/solved/solved_classes.h"

namespace ifov::io {
struct Document;
struct FileStamp;
}  // namespace ifov::io

namespace ifov::session {

struct AssembledScene;

/// The scene of a document as sessions of several of its times share it: read and built once, and lit by each. What was said as
/// it was built each hears again, so that none is told less than one alone. Serves one thread.
class SharedScene {
 public:
  SharedScene();
  ~SharedScene();

  /// Nothing of the scene changes from time to time: none of its objects comes or goes. Else each time has its own.
  static bool serves(const io::Document& document);

  /// That of the first call's `assemble`, which says to `log` what is to be said; `log` may be null.
  AssembledScene scene(const std::function<AssembledScene(LogSink*)>& assemble, LogSink* log);
  bool is_built() const { return scene_ != nullptr; }

  /// Of sessions that differ in their sensors alone: what temperatures are looked up in is worked out once, too.
  void share_temperatures() { classes_.emplace(); }
  /// Null where each session has its own.
  SolvedClasses* classes() { return classes_ ? &*classes_ : nullptr; }

  /// Files whose bytes the scene cache vouched for when it was built.
  std::vector<io::FileStamp> known_files;

 private:
  struct Message {
    bool is_warning = false;
    std::string text;
  };
  class Recorder;

  std::unique_ptr<const AssembledScene> scene_;
  std::vector<Message> said_;
  std::optional<SolvedClasses> classes_;
};

}  // namespace ifov::session
