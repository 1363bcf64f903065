#pragma once

#include <filesystem>

#include "ifov/runs.h"

namespace ifov::session {

/// What is done of the run in a folder, what error is reached and what is left; looks at
/// the headers of the finished tiles alone, and may be asked while the run is at work. Throws InputError
/// where the folder holds no run, SystemError where its state cannot be read.
RunStatus status_of(const std::filesystem::path& folder);

}  // namespace ifov::session
