#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/outcome.h"
#include "ifov/run_control.h"

namespace ifov {

/// How far the run in a folder is, or the series of runs (ifov/series.h).
struct RunStatus {
  bool complete = false;  ///< the products are whole, and nothing below but `kept` is told
  bool kept = false;      ///< complete, and there is what `refine` goes on from
  std::string document, version;
  std::uint64_t seed = 0;
  int share_number = 1, share_count = 1;
  std::size_t tiles_done = 0, tiles_wanted = 0;  ///< of the share
  std::int64_t pixels_done = 0, pixels_wanted = 0, pixels_converged = 0;
  std::uint64_t rays = 0;
  double elapsed_s = 0.0;
  double worst_error_ratio =
      0.0;              ///< largest half-width so far in units of its limit; 0 where no accuracy is asked
  std::string at_work;  ///< "process 4711 on node7"; empty: nobody on this host
  /// Of a series; else none. What is told of tiles and pixels is of the time that is begun and not finished.
  std::size_t times_done = 0, times_wanted = 0;
  std::string text;  ///< what `ifov status` prints
};

/// Looks at the headers of the finished tiles alone, and may be called while the run is at work. Throws InputError where the
/// folder holds no run, SystemError where its state cannot be read.
IFOV_API RunStatus run_status(const std::filesystem::path& folder);

struct MergeOptions {
  std::filesystem::path output_folder;
  int threads = 0;       ///< as recorded in the run record; the work is one thread's
  bool partial = false;  ///< pixels of tiles that are not there hold no value
  LogSink* log = nullptr;
};

/// Makes the products of a run of which each folder holds a share of the tiles (RenderOptions::share); the folders stay as
/// they are. Throws InputError where they are not of one run or tiles are missing, SystemError for files.
IFOV_API Outcome merge(const std::vector<std::filesystem::path>& folders, const MergeOptions& options);

/// The processes of one run under MPI. All programs of them call join(); the first one, which leads, loads and renders with
/// LoadOptions::ranks and RenderOptions::ranks, and all others call work(). They leave together.
class IFOV_API Ranks {
 public:
  struct Work {
    std::vector<std::string> set;  ///< as of Document::read
    int threads = 0;               ///< 0: as many as are usual for a rank
    bool scene_cache = false;
    const CancelToken* cancel = nullptr;
  };

  /// Null where the program was not started as one of several. Throws SystemError where it was, and the library has no
  /// MPI.
  static std::unique_ptr<Ranks> join();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  bool leads() const;
  /// What a rank does that does not lead: reads the scene when it is told to, renders tiles into the run's folder, and returns
  /// when the run is over. What goes wrong the leading rank throws.
  void work(const std::filesystem::path& file, const Work& work) const;

 private:
  struct Inside;
  explicit Ranks(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
  friend struct FacadeAccess;
};

/// "Open MPI 4.1.4"; empty in a library without.
IFOV_API std::string mpi_library();

}  // namespace ifov
