#pragma once

#include <cstdint>
#include <filesystem>

namespace ifov::io {

/// Bytes that may be written in a folder, or where it will be made.
std::uint64_t free_bytes(const std::filesystem::path& folder);

}  // namespace ifov::io
