#include "io/files/free_space.h"

#include <sys/statvfs.h>

namespace ifov::io {

std::uint64_t free_bytes(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::path place = std::filesystem::absolute(folder, ignored);
  while (place.has_relative_path() && !std::filesystem::exists(place, ignored)) place = place.parent_path();
  struct statvfs info {};
  if (statvfs(place.c_str(), &info) != 0) return 0;
  return static_cast<std::uint64_t>(info.f_bavail) * static_cast<std::uint64_t>(info.f_frsize);
}

}  // namespace ifov::io
