#include "io/scene_cache/file_stamp.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <optional>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "core/error.h"
#include "io/files/mapped_file.h"

namespace ifov::io {
namespace {

struct SizeAndTime {
  std::uint64_t bytes = 0;
  std::int64_t time_ns = 0;
};

std::optional<SizeAndTime> look_at(const std::filesystem::path& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) != 0) return std::nullopt;
  return SizeAndTime{static_cast<std::uint64_t>(info.st_size),
                     std::int64_t{info.st_mtim.tv_sec} * 1000000000 + info.st_mtim.tv_nsec};
}

std::array<std::uint64_t, 2> hash_of(const std::filesystem::path& file) {
  const MappedFile mapped(file);
  return content_hash(mapped.bytes());
}

/// The folder of a bare file name is empty, and is the current one.
std::filesystem::path absolute_path(const std::filesystem::path& path) {
  return (path.empty() ? std::filesystem::current_path() : std::filesystem::absolute(path))
      .lexically_normal();
}

}  // namespace

std::array<std::uint64_t, 2> content_hash(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

std::string name_beside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return absolute_path(file).lexically_proximate(absolute_path(folder)).string();
}

FileStamp stamp_of(const std::filesystem::path& file, const std::filesystem::path& cache_folder,
                   std::span<const FileStamp> known) {
  // The time is taken before the bytes: what changes in between is noticed the next time.
  const std::optional<SizeAndTime> seen = look_at(file);
  if (!seen) throw SystemError(format("cannot read '{}': {}", file.string(), std::strerror(errno)));
  FileStamp stamp{name_beside(file, cache_folder), seen->bytes, seen->time_ns, {}};
  for (const FileStamp& one : known)
    if (one.path == stamp.path && one.bytes == stamp.bytes && one.time_ns == stamp.time_ns) return one;
  stamp.hash = hash_of(file);
  return stamp;
}

StampState check_stamp(FileStamp& stamp, const std::filesystem::path& cache_folder) {
  const std::filesystem::path file = absolute_path(cache_folder) / stamp.path;
  const std::optional<SizeAndTime> seen = look_at(file);
  if (!seen || seen->bytes != stamp.bytes) return StampState::changed;
  if (seen->time_ns == stamp.time_ns) return StampState::same;
  try {
    if (hash_of(file) != stamp.hash) return StampState::changed;
  } catch (const SystemError&) {
    return StampState::changed;
  }
  stamp.time_ns = seen->time_ns;
  return StampState::touched;
}

}  // namespace ifov::io
