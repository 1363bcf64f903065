#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

namespace ifov::test {

/// A mesh file in a folder of its own, gone with the object.
class ScratchMesh {
 public:
  ScratchMesh(const std::string& name, const std::string& bytes) {
    static std::atomic<int> count{0};
    folder_ = std::filesystem::temp_directory_path() /
              ("ifov_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
    path_ = folder_ / name;
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~ScratchMesh() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  ScratchMesh(const ScratchMesh&) = delete;
  ScratchMesh& operator=(const ScratchMesh&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// Another file beside it.
  void add(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

 private:
  std::filesystem::path folder_, path_;
};

}  // namespace ifov::test
