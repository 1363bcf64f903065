#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "core/run_start.h"
#include "render/tile_grid.h"
#include "session/session.h"

namespace ifov::session {

class Coordinator;

/// A run keeps each finished tile in its output folder until its products are whole; see docs/guide/runs.md.
struct RunRequest {
  RunOptions options;
  RunStart start = RunStart::fresh;  ///< where the folder holds the tiles of an earlier run
  bool keep_tiles = true;            ///< false: a run that is stopped cannot go on
  bool keep_finished = false;  ///< leave what `refine` can go on from; needs keep_tiles and all of the tiles
  bool refine = false;         ///< take the kept run in the folder to the document's tighter accuracy
  bool anyway = false;         ///< begin also where memory or disk will not do by all that is known
  render::TileShare share;     ///< of the tiles; a share leaves tiles and no products, see merge_runs()
  /// When all must be done; pixels that are not by then hold no value in the products.
  std::optional<std::chrono::steady_clock::time_point> deadline;

  Coordinator* coordinator = nullptr;  ///< of ranks that share the tiles; needs keep_tiles

  /// Of the options, else as the document says, with the share in its name. Throws SystemError where the latter
  /// leads through a link.
  std::filesystem::path folder(const Session& session) const;
};

struct RunResult {
  RunSummary summary;          ///< without files for a share
  std::size_t tiles_done = 0;  ///< of the share, those of earlier starts included
  std::size_t tiles_left = 0;  ///< not 0: the deadline came first
};

/// Errors as of Session; EnvironmentErrors say that what is finished is kept.
RunResult render_run(const Session& session, const RunRequest& request);

}  // namespace ifov::session
