#pragma once

#include <filesystem>
#include <string_view>

namespace ifov::studies {

/// Makes a folder where there is none; SystemError where that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes a file whole; SystemError where that fails.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace ifov::studies
