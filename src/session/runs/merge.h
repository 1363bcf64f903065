#pragma once

#include <filesystem>
#include <vector>

#include "session/runs/run.h"

namespace ifov::session {

struct MergeOptions {
  std::filesystem::path output_folder;
  int threads = 0;       ///< as recorded in the run record; the work is one thread's
  bool partial = false;  ///< pixels of tiles that are not there hold no value
  LogSink* log = nullptr;
};

/// Makes the products of a run of which each folder holds a share of the tiles; the folders stay as they are.
/// Throws InputError where they are not of one run or tiles are missing, EnvironmentError for files.
RunResult merge_runs(const std::vector<std::filesystem::path>& folders, const MergeOptions& options);

}  // namespace ifov::session
