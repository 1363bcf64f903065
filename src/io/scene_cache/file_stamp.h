#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace ifov::io {

/// What a file was like when it was read. Size and time tell quickly that it is the same; where only the time
/// differs, its bytes do.
struct FileStamp {
  std::string path;  ///< relative to the folder of the cache, where it can be
  std::uint64_t bytes = 0;
  std::int64_t time_ns = 0;             ///< of its last change
  std::array<std::uint64_t, 2> hash{};  ///< XXH3, 128 bits, of its bytes
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// XXH3, 128 bits.
std::array<std::uint64_t, 2> content_hash(std::span<const std::byte> bytes);

/// The path of a file relative to a folder, both taken from the working directory.
std::string name_beside(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Throws SystemError where the file cannot be read. A file of the size and time of one of `known`, stamps of the
/// same folder, has its hash and is not read.
FileStamp stamp_of(const std::filesystem::path& file, const std::filesystem::path& cache_folder,
                   std::span<const FileStamp> known = {});

enum class StampState { same, touched, changed };

/// Whether the file is what it was; `touched`: the same bytes at another time, which is then entered.
StampState check_stamp(FileStamp& stamp, const std::filesystem::path& cache_folder);

}  // namespace ifov::io
