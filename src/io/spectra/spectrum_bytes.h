#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ifov::io {

/// The whole of a file. Throws SystemError where it cannot be read, InputError where it is larger than
/// `most`.
std::string read_bytes(const std::filesystem::path& path, std::uintmax_t most);

}  // namespace ifov::io
