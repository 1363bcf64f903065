#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/call_scope.h"
#include "session/runs/run.h"
#include "session/series/series_times.h"
#include "session/session.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// One document rendered at several times, along the same paths where it can be, each into a folder of its own. Its scene is read and built once
/// (SharedScene).
struct SeriesRequest {
  SeriesTimes times;
  std::function<io::Document(const std::string& time)> document;  ///< with that time in place of its own
  std::shared_ptr<const Call::Data> inputs;                       ///< of all that is read for it
  LoadOptions load;
  RunRequest run;       ///< of each time; the folder is that of all of them. Alone, and all of the tiles
  bool strict = false;  ///< render no time whose loading warns
};

struct SeriesResult {
  struct OfTime {
    std::string time;
    std::filesystem::path folder;
    bool was_there = false;    ///< made by an earlier start
    RunResult run;             ///< of one that was there: its totals and whether it was judged
    std::size_t warnings = 0;  ///< of loading
  };
  std::filesystem::path folder;
  std::vector<OfTime> times;  ///< that are made; fewer than were asked for where the deadline came first
  std::size_t times_left = 0;
  Progress totals;                 ///< of this start
  std::vector<ProductFile> files;  ///< of the series
  std::vector<std::string> warnings;
};

/// Errors as of Session and render_run, with the time that they are about. Finished times and tiles are kept.
SeriesResult render_series(const SeriesRequest& request);

}  // namespace ifov::session
