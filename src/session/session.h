#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::io {
struct Document;
struct DocumentOverride;
}  // namespace ifov::io

namespace ifov::session {

struct Parts;
class SharedScene;

struct RunOptions {
  int threads = 0;                      ///< 0: all cores
  std::filesystem::path output_folder;  ///< empty: as the document says, else beside it
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
  LogSink* log = nullptr;
};

struct LoadOptions {
  /// Keep what is worked out from large files and for the atmosphere beside the document, and use it.
  bool scene_cache = false;
  int threads = 0;                      ///< for the atmosphere; 0: all cores
  const CancelToken* cancel = nullptr;  ///< asked while the atmosphere is worked out
  ProgressSink* progress = nullptr;     ///< of the atmosphere: solutions instead of pixels
  SharedScene* shared = nullptr;        ///< of the same document at other times; null: it is alone
  bool unseen_temperatures = false;  ///< measure solved ones also where neither camera nor mirror shows them
};

struct ProductFile {
  std::filesystem::path path;
  std::string what;  ///< one line for the user: "radiance, 210 channels, ENVI"
};

struct RunSummary {
  std::filesystem::path folder;
  std::vector<ProductFile> files;
  Progress totals;
  std::string accuracy_statement;  ///< plain words: what was asked for, what was reached, where it was not
  bool judged = false;             ///< an accuracy was asked for
  bool one_value = false;          ///< all pixels, more than one, hold the same in every channel
};

/// One document, loaded and checked, that can be rendered; programs have it as ifov::Simulation.
/// Errors: ifov::InputError for the user's input, ifov::SystemError for files and memory, ifov::Cancelled.
class Session {
 public:
  /// Reads every file the document names and builds the scene. `log` may be null.
  static Session load(const io::Document& document, LogSink* log, const LoadOptions& options = {});
  /// The same of a document in a file, with other values for some of its keys.
  static Session load_file(const std::string& document, std::span<const io::DocumentOverride> overrides,
                           LogSink* log, const LoadOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// What was loaded, in a few lines for people (`ifov check`): objects, triangles, materials, channels, floors.
  std::string description() const;

  /// What was warned of while it was loaded: what is left out, what is most likely not meant.
  const std::vector<std::string>& warnings() const;

  RunSummary render(const RunOptions& options) const;

  /// The parts, for studies and benchmarks that need them in memory.
  using Parts = session::Parts;
  const Parts& parts() const { return *parts_; }

 private:
  explicit Session(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace ifov::session
