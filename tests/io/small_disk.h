#pragma once

#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>

namespace ifov::test {

/// A file system of a few hundred kB; needs root.
class SmallDisk {
 public:
  explicit SmallDisk(const std::filesystem::path& path, const char* size) : path_(path) {
    mounted_ = geteuid() == 0 && mount("tmpfs", path.c_str(), "tmpfs", 0, size) == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(path_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }

 private:
  std::filesystem::path path_;
  bool mounted_ = false;
};

}  // namespace ifov::test
