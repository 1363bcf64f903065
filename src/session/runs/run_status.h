#pragma once

#include <filesystem>
#include <string>

namespace ifov::session {

/// What is done of the run in a folder, what error is reached and what is left, in lines for people; looks at
/// the headers of the finished tiles alone, and may be asked while the run is at work. Throws InputError
/// where the folder holds no run, EnvironmentError where its state cannot be read.
std::string describe_run(const std::filesystem::path& folder);

}  // namespace ifov::session
