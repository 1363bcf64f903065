#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace ifov::io {

/// A file, or an asset that holds the bytes of one, as memory, read only. What is not looked at is not read; pages that memory is short of are read again.
class MappedFile {
 public:
  /// Throws SystemError where the file cannot be read or is not a plain file; InputError as of InputFile.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return {data_, size_}; }

 private:
  std::shared_ptr<const std::string> memory_;  ///< of an asset; null: the file is mapped
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  int place_ = -1;  ///< in the list that mapped_file_at() looks through
};

/// Name of the mapped file that has an address, or null: for a handler of SIGBUS, which comes where a file was cut short
/// after it was mapped. Safe there: takes no lock and no memory.
const char* mapped_file_at(const void* address);

}  // namespace ifov::io
