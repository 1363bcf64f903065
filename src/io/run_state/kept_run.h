#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "io/run_state/tile_index.h"
#include "render/tile_sink.h"

namespace ifov::io {

struct RunPlan;

/// Where a finished run keeps its tiles, to be refined: the folder `run.kept` of its output folder.
std::filesystem::path kept_folder(const std::filesystem::path& folder);

/// The plan of the kept run. Throws SystemError where it cannot be read.
RunPlan read_kept_plan(const std::filesystem::path& folder);

/// The tiles of a kept run, read one by one.
class KeptTiles final : public render::EarlierTiles {
 public:
  /// Looks at the headers of all tiles. `log` may be null.
  KeptTiles(const std::filesystem::path& folder, const RunPlan& plan, LogSink* log);

  /// False where the tile is damaged, which the log is told.
  bool read(std::size_t index, sampling::TileResult& tile) override;

 private:
  TileIndex index_;
  LogSink* log_;
};

/// Whether two documents say the same but for the error that is asked for; comments and blanks do not count.
bool differ_in_error_alone(const std::string& one, const std::string& other);

}  // namespace ifov::io
