#pragma once

#include <filesystem>
#include <vector>

#include "ifov/runs.h"
#include "session/runs/run.h"

namespace ifov::session {

/// Makes the products of a run of which each folder holds a share of the tiles; the folders stay as they are.
/// Throws InputError where they are not of one run or tiles are missing, SystemError for files.
RunResult merge_runs(const std::vector<std::filesystem::path>& folders, const MergeOptions& options);

}  // namespace ifov::session
