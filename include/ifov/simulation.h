#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/outcome.h"
#include "ifov/run_control.h"
#include "ifov/tile.h"

namespace ifov {

/// How a document is loaded. Pointers may be null, and what they point to must live as long as the call.
struct LoadOptions {
  /// Keep beside the document what is worked out from large files, and use it (.ifovcache).
  bool scene_cache = false;
  int threads = 0;                      ///< for the atmosphere; 0: all cores
  const CancelToken* cancel = nullptr;  ///< asked while the atmosphere is worked out
  ProgressSink* progress = nullptr;     ///< of the atmosphere: solutions instead of pixels
  LogSink* log = nullptr;
};

/// How products are made. Names are those of the command line's options where nothing else is said, and messages speak of
/// those. Pointers as of LoadOptions.
struct RenderOptions {
  std::filesystem::path folder;      ///< --output; empty: as the document says
  int threads = 0;                   ///< 0: all cores; the result is the same for any number
  RunStart start = RunStart::fresh;  ///< --resume, --restart
  bool keep_tiles = true;            ///< false, --no-state: a run that is stopped cannot go on
  bool keep = false;                 ///< leave, beside the products, what `refine` can go on from
  bool refine = false;               ///< take the kept run in the folder to the document's tighter accuracy
  bool anyway = false;               ///< begin also where memory or disk will not do
  /// --time-limit: when products are to be whole; pixels not reached by then hold no value.
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
  const CancelToken* cancel = nullptr;  ///< asked between batches of rays
  ProgressSink* progress = nullptr;
  LogSink* log = nullptr;
};

/// How tiles are made that stay in memory; see RenderOptions.
struct TileOptions {
  int threads = 0;
  std::optional<std::chrono::steady_clock::time_point> deadline = {};  ///< when no more tiles come
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
};

/// A document with all that it names: every file read, the scene built, ready to be rendered. It does not change once it
/// is loaded: several threads may render it at once, each into a folder of its own, and get the same bytes as one.
///
/// Errors of all calls: InputError for what the user wrote; EnvironmentError for files, disk and memory (std::bad_alloc
/// while a scene is loaded); Cancelled. exit_code_of() says what the program would return for each. Nothing is printed.
class IFOV_API Simulation {
 public:
  static Simulation load(const Document& document, const LoadOptions& options = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Size and channels.
  ImageDescription image() const;
  /// What was loaded and where it is, as `ifov check` prints it: lines, each with its end.
  std::string description() const;
  /// What was warned of while it was loaded: what is left out, what is most likely not meant.
  const std::vector<std::string>& warnings() const;

  /// Makes the products of `ifov render`, with the run record, in a folder. A run that is stopped leaves what is finished
  /// there, and products under other names (.part).
  Outcome render(const RenderOptions& options = {}) const;

  /// Hands finished tiles to `sink`, and writes no file. Values are those of the products, bit for bit.
  Outcome render_tiles(TileSink& sink, const TileOptions& options = {}) const;

 private:
  struct Inside;
  explicit Simulation(std::unique_ptr<const Inside> inside);
  std::unique_ptr<const Inside> inside_;
};

}  // namespace ifov
