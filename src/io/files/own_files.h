#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "io/files/descriptor.h"

namespace ifov::io {

// What ifov writes beside files of others. An archive from a stranger may hold links under the names that ifov
// writes; none of them is followed. All errors are EnvironmentErrors that name the link.

/// A folder that begins with `trusted` (which may be a link: the user's own) may not be a link below that, nor
/// lead through one.
void refuse_links_below(const std::filesystem::path& trusted, const std::filesystem::path& folder);

/// Refuses a folder that is itself a link; one that is not there will do.
void refuse_link(const std::filesystem::path& folder);

/// Makes a file that was not there, for reading and writing, in an open folder (or AT_FDCWD). What has the name
/// is taken away first: a link goes, and not what it leads to. -1 and errno where that cannot be.
Descriptor create_file_at(int folder, const std::filesystem::path& name);

/// All of so many bytes of an open file. Where fewer lie there, a SystemError that names `path`.
void read_whole(const Descriptor& file, const std::filesystem::path& path, std::uint64_t offset, void* to,
                std::size_t bytes);

/// A plain file that ifov wrote, open for reading; no link.
class OwnFile {
 public:
  /// False where there is none.
  explicit OwnFile(const std::filesystem::path& path);
  explicit operator bool() const { return static_cast<bool>(file_); }
  /// SystemError where fewer bytes lie there.
  void read_at(std::uint64_t offset, void* to, std::size_t bytes) const {
    read_whole(file_, path_, offset, to, bytes);
  }

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

/// The text of a file that ifov wrote; no link.
std::string read_own_file(const std::filesystem::path& path);

/// A new file that grows from front to back under a passing name, and gets its own name when it is whole.
class NewFile {
 public:
  NewFile(std::filesystem::path path, std::filesystem::path part_path);
  /// Takes the file away unless it was published.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void append(std::span<const std::byte> bytes);
  void write_head(std::span<const std::byte> bytes);  ///< over the first bytes
  void publish();

 private:
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);

  std::filesystem::path path_, part_path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
  bool published_ = false;
};

/// Writes a whole file in the place of what has its name.
void write_new_file(const std::filesystem::path& path, std::string_view content);

}  // namespace ifov::io
