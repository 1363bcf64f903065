#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"

namespace ifov::test {

/// A small file that is there as long as the object is.
class ScratchFile {
 public:
  ScratchFile(const std::string& name, const std::string& content)
      : path_(std::filesystem::temp_directory_path() /
              ("ifov_" + std::to_string(::getpid()) + "_" + std::to_string(++count_) + "_" + name)) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~ScratchFile() {
    std::error_code error;
    std::filesystem::remove(path_, error);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  static inline int count_ = 0;
  std::filesystem::path path_;
};

/// The message of the InputError that reading a file throws, without the file's path; "no error" where it
/// throws none.
template <class Read>
std::string input_error(const std::filesystem::path& path, const Read& read) {
  try {
    read(path);
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string name = path.string();
    if (const std::size_t at = text.find(name); at != std::string::npos)
      text.replace(at, name.size(), "FILE");
    return text;
  }
  return "no error";
}

/// The same for a file of this content.
template <class Read>
std::string input_error(const std::string& content, const Read& read) {
  const ScratchFile file("table.txt", content);
  return input_error(file.path(), read);
}

}  // namespace ifov::test
