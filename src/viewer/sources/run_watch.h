#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ifov/runs.h"
#include "sampling/pixel_rect.h"

namespace ifov::io {
struct RunPlan;
class TileIndex;
}  // namespace ifov::io
namespace ifov::sampling {
struct TileResult;
}

namespace ifov::viewer {

/// A run that another process may be at work on, as its state folder shows it at one moment. From any thread.
class RunWatch {
 public:
  /// Throws as run_status() and io::read_plan().
  explicit RunWatch(const std::filesystem::path& folder);
  ~RunWatch();

  const RunStatus& status() const { return status_; }
  const io::RunPlan& plan() const { return *plan_; }
  int channels() const;
  const std::vector<sampling::PixelRect>& grid() const { return grid_; }
  const std::vector<bool>& done() const { return done_; }

  /// Means of one channel over the pixels of a finished tile, row by row, and the pixels' largest half-widths over their
  /// limits. Throws SystemError where the tile is damaged or lies there no more.
  struct Tile {
    std::vector<float> mean, worst_ratio;
  };
  Tile tile(std::size_t index, std::size_t channel) const;

 private:
  bool read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const;

  std::filesystem::path folder_;
  RunStatus status_;
  std::unique_ptr<const io::RunPlan> plan_;
  std::unique_ptr<const io::TileIndex> index_;
  std::vector<sampling::PixelRect> grid_;
  std::vector<bool> done_;
};

/// Asks the run in a folder, whatever process is at work on it, to stop as Ctrl-C does. Throws SystemError where that cannot be left there.
void request_stop(const std::filesystem::path& folder);

/// Whether a folder holds the state of an unfinished run.
bool holds_unfinished_run(const std::filesystem::path& folder);

}  // namespace ifov::viewer
