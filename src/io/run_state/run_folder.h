#pragma once

#include <filesystem>

namespace ifov::io {

/// The folder of a run's state in its output folder, and the plan in it.
std::filesystem::path state_folder(const std::filesystem::path& folder);
std::filesystem::path plan_file(const std::filesystem::path& folder);
/// Who puts a file there, whatever is in it, asks the run that is at work to stop as Ctrl-C does.
std::filesystem::path stop_file(const std::filesystem::path& folder);

}  // namespace ifov::io
