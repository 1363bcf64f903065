#pragma once

#include <sys/uio.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/files/descriptor.h"

namespace ifov::io {

/// What is as large as this goes past the page cache: there it would drive out all else and wait for the disk anyway.
inline constexpr std::uint64_t kManyBytes = std::uint64_t{1} << 30;

/// A file being made: it is called `<final path>.part` until publish(). Two writers of one path exclude each
/// other. All errors are ifov::SystemError and name the path, what was wanted and what was free.
class PartFile {
 public:
  /// What has the `.part` name already: it goes; or, where it is a plain file of this user alone, it is gone on with.
  enum class Left { replace, go_on };

  explicit PartFile(std::filesystem::path final_path, Left left = Left::replace);
  /// Closes; the `.part` file stays.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Takes `bytes` of disk space now, so that later writes within them cannot meet a full disk; no more are left of what
  /// is gone on with.
  void reserve(std::uint64_t bytes);

  /// Later pieces of a MiB and more go past the page cache, where the file system lets them (O_DIRECT).
  void bypass_page_cache();

  /// Safe to call from several threads.
  void write_at(std::uint64_t offset, const void* data, std::size_t bytes);
  /// Pieces of memory, one behind the other in the file.
  void write_at(std::uint64_t offset, std::span<const iovec> pieces);
  void read_at(std::uint64_t offset, void* data, std::size_t bytes) const;

  void sync();
  /// Gives the file, which must have been synced, its final name.
  void publish();
  /// Closes and removes the `.part` file, unless an earlier start has begun it.
  void discard();

  const std::filesystem::path& final_path() const { return final_path_; }
  const std::filesystem::path& part_path() const { return part_path_; }

 private:
  void write_directly(std::uint64_t offset, std::span<const iovec> pieces);
  void close_all();
  bool write_block(std::uint64_t offset, const void* block, std::size_t bytes);

  std::filesystem::path final_path_, part_path_;
  Descriptor folder_, file_, direct_;
  std::atomic<bool> bypasses_{false};
  bool gone_on_with_ = false;
};

/// Writes a small file whole, synced, still under its `.part` name.
void write_part(PartFile& file, std::string_view content);

/// ifov::SystemError unless the folder exists (it is made where it can be) and has `bytes` free.
void require_space(const std::filesystem::path& folder, std::uint64_t bytes);

/// SHA-256 of a file that is still being made.
std::string checksum(const PartFile& file, std::uint64_t bytes);

/// Makes renames in a folder durable.
void sync_folder(const std::filesystem::path& folder);

}  // namespace ifov::io
