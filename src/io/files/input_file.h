#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "io/files/descriptor.h"

namespace ifov::io {

/// A plain file that a document or a user names, or an asset that holds the bytes of one, open for reading. All that ifov reads of others goes through here, where
/// the folder of current_inputs() is held.
class InputFile {
 public:
  /// Throws SystemError that says why the file cannot be read; folders, pipes and devices are refused. InputError
  /// where there is no such asset, or it holds arrays.
  explicit InputFile(const std::filesystem::path& path);

  std::uint64_t size() const { return size_; }             ///< when it was opened
  int descriptor() const { return descriptor_.number(); }  ///< below 0 of an asset
  /// The bytes of an asset; null of a file.
  const std::shared_ptr<const std::string>& memory() const { return memory_; }

  /// How many bytes lie there; fewer than asked for at the end of the file. Throws Cancelled.
  std::size_t read_at(std::uint64_t offset, std::span<char> bytes) const;
  /// From the beginning to the end.
  std::string text() const;

 private:
  std::filesystem::path path_;
  Descriptor descriptor_;
  std::shared_ptr<const std::string> memory_;
  std::uint64_t size_ = 0;
};

/// The whole of a file. Errors as of InputFile.
std::string read_input(const std::filesystem::path& path);

}  // namespace ifov::io
