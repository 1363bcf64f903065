#include "io/products/part_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "core/byte_count.h"
#include "core/error.h"

namespace ifov::io {
namespace {

std::uint64_t free_bytes(const std::filesystem::path& folder) {
  struct statvfs info {};
  if (statvfs(folder.c_str(), &info) != 0) return 0;
  return static_cast<std::uint64_t>(info.f_bavail) * static_cast<std::uint64_t>(info.f_frsize);
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

[[noreturn]] void fail_write(const std::filesystem::path& path, std::uint64_t wanted, int error) {
  const std::string free = byte_count(free_bytes(folder_of(path)));
  if (error == ENOSPC || error == EDQUOT || error == EFBIG)
    throw EnvironmentError(format("{}: the disk is full: {} wanted, {} free ({})", path.string(),
                                  byte_count(wanted), free, std::strerror(error)));
  throw EnvironmentError(format("{}: cannot write {}: {} ({} free)", path.string(), byte_count(wanted),
                                std::strerror(error), free));
}

}  // namespace

PartFile::PartFile(std::filesystem::path final_path)
    : final_path_(std::move(final_path)), part_path_(final_path_) {
  part_path_ += ".part";
  std::error_code ignored;
  if (std::filesystem::is_directory(final_path_, ignored))
    throw EnvironmentError(format("{}: cannot be written: a folder has this name", final_path_.string()));
  descriptor_ = open(part_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0)
    throw EnvironmentError(format("{}: cannot be written: {}", part_path_.string(), std::strerror(errno)));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw EnvironmentError(format("{}: another run is writing this file", part_path_.string()));
  }
  if (ftruncate(descriptor_, 0) != 0) {
    const int error = errno;
    close(descriptor_);
    fail_write(part_path_, 0, error);
  }
}

PartFile::~PartFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void PartFile::reserve(std::uint64_t bytes) {
  if (bytes == 0) return;
  // fallocate and not posix_fallocate, which writes every byte on file systems that cannot reserve.
  if (fallocate(descriptor_, 0, 0, static_cast<off_t>(bytes)) == 0) return;
  if (errno != EOPNOTSUPP && errno != ENOSYS) fail_write(part_path_, bytes, errno);
  require_space(folder_of(part_path_), bytes);
  if (ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) fail_write(part_path_, bytes, errno);
}

void PartFile::write_at(std::uint64_t offset, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = pwrite(descriptor_, from, bytes, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail_write(part_path_, bytes, written < 0 ? errno : ENOSPC);
    from += written;
    offset += static_cast<std::uint64_t>(written);
    bytes -= static_cast<std::size_t>(written);
  }
}

void PartFile::write_rows_at(std::uint64_t offset, const void* data, std::size_t row_bytes,
                             std::size_t stride_bytes, std::size_t rows) {
  if (row_bytes == stride_bytes) return write_at(offset, data, row_bytes * rows);
  constexpr std::size_t kAtOnce = 1024;  // IOV_MAX of Linux
  std::vector<iovec> pieces(std::min(rows, kAtOnce));
  const auto* from = static_cast<const std::byte*>(data);
  for (std::size_t first = 0; first < rows; first += kAtOnce) {
    const std::size_t count = std::min(rows - first, kAtOnce);
    for (std::size_t k = 0; k < count; ++k)
      pieces[k] = {const_cast<std::byte*>(from + (first + k) * stride_bytes), row_bytes};
    const ssize_t written = pwritev(descriptor_, pieces.data(), static_cast<int>(count),
                                    static_cast<off_t>(offset + first * row_bytes));
    if (written == static_cast<ssize_t>(count * row_bytes)) continue;
    for (std::size_t k = 0; k < count; ++k)  // interrupted or failing: row by row, which says why
      write_at(offset + (first + k) * row_bytes, pieces[k].iov_base, row_bytes);
  }
}

void PartFile::read_at(std::uint64_t offset, void* data, std::size_t bytes) const {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t got = pread(descriptor_, to, bytes, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      throw EnvironmentError(format("{}: cannot be read at byte {}: {}", part_path_.string(), offset,
                                    got < 0 ? std::strerror(errno) : "the file ends"));
    to += got;
    offset += static_cast<std::uint64_t>(got);
    bytes -= static_cast<std::size_t>(got);
  }
}

void PartFile::sync() {
  if (fdatasync(descriptor_) != 0 && errno != EINVAL) fail_write(part_path_, 0, errno);
}

void PartFile::publish() {
  if (rename(part_path_.c_str(), final_path_.c_str()) != 0)
    throw EnvironmentError(format("{}: cannot be renamed to {}: {}", part_path_.string(),
                                  final_path_.filename().string(), std::strerror(errno)));
  close(descriptor_);
  descriptor_ = -1;
}

void PartFile::discard() {
  unlink(part_path_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
}

void write_part(PartFile& file, std::string_view content) {
  file.reserve(content.size());
  file.write_at(0, content.data(), content.size());
  file.sync();
}

void require_space(const std::filesystem::path& folder, std::uint64_t bytes) {
  std::error_code error;
  const std::filesystem::path target = folder.empty() ? "." : folder;
  std::filesystem::create_directories(target, error);
  if (error && !std::filesystem::is_directory(target))
    throw EnvironmentError(format("{}: the folder cannot be made: {}", target.string(), error.message()));
  if (access(target.c_str(), W_OK | X_OK) != 0)
    throw EnvironmentError(
        format("{}: the folder cannot be written: {}", target.string(), std::strerror(errno)));
  const std::uint64_t free = free_bytes(target);
  if (bytes > free)
    throw EnvironmentError(format("{}: the disk is full: the products take {}, {} free", target.string(),
                                  byte_count(bytes), byte_count(free)));
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace ifov::io
