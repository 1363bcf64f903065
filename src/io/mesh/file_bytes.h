#pragma once

#include <filesystem>
#include <string>

namespace ifov::io {

/// The whole of a regular file. Throws EnvironmentError where it cannot be read.
std::string read_file_bytes(const std::filesystem::path& path);

}  // namespace ifov::io
