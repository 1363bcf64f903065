#pragma once

#include <filesystem>

#include "ifov/runs.h"

namespace ifov::session {

/// How far the run in a folder is, or the series of runs. Errors as of status_of().
RunStatus status_of_any(const std::filesystem::path& folder);

}  // namespace ifov::session
