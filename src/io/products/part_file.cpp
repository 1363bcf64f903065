#include "io/products/part_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>

#include "core/byte_count.h"
#include "core/error.h"
#include "io/files/file_reasons.h"
#include "io/files/own_files.h"
#include "io/product_parts/sha256.h"

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
  if (error == EFBIG)
    throw SystemError(
        format("{}: cannot write {}: {}", path.string(), byte_count(wanted), file_reason(error)));
  if (error == ENOSPC || error == EDQUOT)
    throw SystemError(format("{}: the disk is full: {} wanted, {} free ({})", path.string(),
                             byte_count(wanted), free, std::strerror(error)));
  throw SystemError(format("{}: cannot write {}: {} ({} free)", path.string(), byte_count(wanted),
                           std::strerror(error), free));
}

/// By another; takes the lock where nobody has it. File systems without locks say that nobody has.
bool is_locked(const Descriptor& file) {
  return flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

bool is_unlinked(const Descriptor& file) {
  struct stat info {};
  return fstat(file.number(), &info) == 0 && info.st_nlink == 0;
}

/// With no other name, which could be that of somebody's file.
bool is_plain_file_of_ours(const Descriptor& file) {
  struct stat info {};
  return fstat(file.number(), &info) == 0 && S_ISREG(info.st_mode) && info.st_nlink == 1 &&
         info.st_uid == geteuid();
}

constexpr std::size_t kBlock = 4096;                  // no file system asks for more
constexpr std::size_t kChunk = std::size_t{2} << 20;  // a huge page
constexpr std::size_t kLeastDirect = std::size_t{1} << 20;

struct FreeMemory {
  void operator()(void* memory) const { std::free(memory); }
};

std::size_t bytes_of(std::span<const iovec> pieces) {
  std::size_t bytes = 0;
  for (const iovec& piece : pieces) bytes += piece.iov_len;
  return bytes;
}

/// Copies what lies in pieces, front to back.
class PieceReader {
 public:
  explicit PieceReader(std::span<const iovec> pieces) : pieces_(pieces) {}
  void read(std::byte* to, std::size_t bytes) {
    while (bytes > 0) {
      const iovec& piece = pieces_.front();
      const std::size_t part = std::min(bytes, piece.iov_len - taken_);
      std::memcpy(to, static_cast<const std::byte*>(piece.iov_base) + taken_, part);
      to += part;
      bytes -= part;
      taken_ += part;
      if (taken_ < piece.iov_len) continue;
      pieces_ = pieces_.subspan(1);
      taken_ = 0;
    }
  }

 private:
  std::span<const iovec> pieces_;
  std::size_t taken_ = 0;  // of the first
};

}  // namespace

PartFile::PartFile(std::filesystem::path final_path, Left left_over)
    : final_path_(std::move(final_path)), part_path_(final_path_) {
  part_path_ += ".part";
  std::error_code ignored;
  if (std::filesystem::is_directory(final_path_, ignored))
    throw SystemError(format("{}: cannot be written: a folder has this name", final_path_.string()));
  const std::filesystem::path part_name = part_path_.filename();
  const auto cannot = [&](const std::string& why) {
    return SystemError(format("{}: cannot be written: {}", part_path_.string(), why));
  };
  folder_ = Descriptor(open(folder_of(final_path_).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder_) throw cannot(file_reason(errno));
  // What a killed run left is locked by nobody. It goes and is not written over: it may have another name elsewhere.
  Descriptor left(
      openat(folder_.number(), part_name.c_str(),
             (left_over == Left::go_on ? O_RDWR : O_RDONLY) | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (left && is_locked(left))
    throw SystemError(format("{}: another run is writing this file", part_path_.string()));
  if (left && left_over == Left::go_on && is_plain_file_of_ours(left)) {
    file_ = std::move(left);
    gone_on_with_ = true;
    return;
  }
  file_ = create_file_at(folder_.number(), part_name);
  if (!file_) throw cannot(file_reason(errno));
  // Another run may have taken the new file for one that was left.
  if (is_locked(file_) || is_unlinked(file_))
    throw SystemError(format("{}: another run is writing this file", part_path_.string()));
}

PartFile::~PartFile() = default;

void PartFile::close_all() {
  direct_.reset();
  file_.reset();
}

void PartFile::reserve(std::uint64_t bytes) {
  if (bytes == 0) return;
  struct stat info {};
  if (gone_on_with_ && fstat(file_.number(), &info) == 0 &&
      static_cast<std::uint64_t>(info.st_size) > bytes &&
      ftruncate(file_.number(), static_cast<off_t>(bytes)) != 0)
    fail_write(part_path_, bytes, errno);
  // fallocate and not posix_fallocate, which writes every byte on file systems that cannot reserve.
  if (fallocate(file_.number(), 0, 0, static_cast<off_t>(bytes)) == 0) return;
  if (errno != EOPNOTSUPP && errno != ENOSYS) fail_write(part_path_, bytes, errno);
  require_space(folder_of(part_path_), bytes);
  if (ftruncate(file_.number(), static_cast<off_t>(bytes)) != 0) fail_write(part_path_, bytes, errno);
}

void PartFile::write_at(std::uint64_t offset, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = pwrite(file_.number(), from, bytes, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail_write(part_path_, bytes, written < 0 ? errno : ENOSPC);
    from += written;
    offset += static_cast<std::uint64_t>(written);
    bytes -= static_cast<std::size_t>(written);
  }
}

void PartFile::bypass_page_cache() {
  if (!direct_)
    direct_ = Descriptor(openat(folder_.number(), part_path_.filename().c_str(),
                                O_WRONLY | O_DIRECT | O_NOFOLLOW | O_CLOEXEC));
  bypasses_ = static_cast<bool>(direct_);
}

void PartFile::write_at(std::uint64_t offset, std::span<const iovec> pieces) {
  if (bypasses_ && bytes_of(pieces) >= kLeastDirect) return write_directly(offset, pieces);
  constexpr std::size_t kAtOnce = 1024;  // IOV_MAX of Linux
  while (!pieces.empty()) {
    const auto some = pieces.first(std::min(pieces.size(), kAtOnce));
    const std::size_t bytes = bytes_of(some);
    const ssize_t written =
        pwritev(file_.number(), some.data(), static_cast<int>(some.size()), static_cast<off_t>(offset));
    if (written != static_cast<ssize_t>(bytes)) {  // interrupted or failing: piece by piece, which says why
      std::uint64_t at = offset;
      for (const iovec& piece : some) {
        write_at(at, piece.iov_base, piece.iov_len);
        at += piece.iov_len;
      }
    }
    offset += bytes;
    pieces = pieces.subspan(some.size());
  }
}

/// Whole blocks of the file past the cache; what is left of a block at either end through it.
void PartFile::write_directly(std::uint64_t offset, std::span<const iovec> pieces) {
  const std::unique_ptr<std::byte, FreeMemory> chunk(
      static_cast<std::byte*>(std::aligned_alloc(kChunk, kChunk)));
  if (!chunk) throw std::bad_alloc();
  madvise(chunk.get(), kChunk, MADV_HUGEPAGE);
  PieceReader reader(pieces);
  for (std::size_t left = bytes_of(pieces); left > 0;) {
    const std::size_t in_block = offset % kBlock;
    const bool whole = in_block == 0 && left >= kBlock;
    const std::size_t bytes =
        whole ? std::min(left, kChunk) / kBlock * kBlock : std::min(left, kBlock - in_block);
    reader.read(chunk.get(), bytes);
    if (!whole || !write_block(offset, chunk.get(), bytes)) write_at(offset, chunk.get(), bytes);
    offset += bytes;
    left -= bytes;
  }
}

/// False where the file system takes no such write; it is not asked again.
bool PartFile::write_block(std::uint64_t offset, const void* block, std::size_t bytes) {
  if (!bypasses_) return false;
  const ssize_t written = pwrite(direct_.number(), block, bytes, static_cast<off_t>(offset));
  if (written == static_cast<ssize_t>(bytes)) return true;
  if (written < 0 && errno == EINVAL) bypasses_ = false;
  return false;
}

void PartFile::read_at(std::uint64_t offset, void* data, std::size_t bytes) const {
  read_whole(file_, part_path_, offset, data, bytes);
}

void PartFile::sync() {
  if (fdatasync(file_.number()) != 0 && errno != EINVAL) fail_write(part_path_, 0, errno);
}

void PartFile::publish() {
  if (renameat(folder_.number(), part_path_.filename().c_str(), folder_.number(),
               final_path_.filename().c_str()) != 0)
    throw SystemError(format("{}: cannot be renamed to {}: {}", part_path_.string(),
                             final_path_.filename().string(), std::strerror(errno)));
  close_all();
}

void PartFile::discard() {
  if (!gone_on_with_) unlinkat(folder_.number(), part_path_.filename().c_str(), 0);
  close_all();
}

void write_part(PartFile& file, std::string_view content) {
  file.reserve(content.size());
  file.write_at(0, content.data(), content.size());
  file.sync();
}

std::string checksum(const PartFile& file, std::uint64_t bytes) {
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
  const auto piece = std::make_unique_for_overwrite<char[]>(kPiece);
  Sha256 sum;
  for (std::uint64_t offset = 0; offset < bytes; offset += kPiece) {
    const std::size_t size = std::min(kPiece, bytes - offset);
    file.read_at(offset, piece.get(), size);
    sum.update(piece.get(), size);
  }
  return sum.digest();
}

void require_space(const std::filesystem::path& folder, std::uint64_t bytes) {
  std::error_code error;
  const std::filesystem::path target = folder.empty() ? "." : folder;
  std::filesystem::create_directories(target, error);
  if (error && !std::filesystem::is_directory(target))
    throw SystemError(format("{}: the folder cannot be made: {}", target.string(), error.message()));
  if (access(target.c_str(), W_OK | X_OK) != 0)
    throw SystemError(format("{}: the folder cannot be written: {}", target.string(), std::strerror(errno)));
  const std::uint64_t free = free_bytes(target);
  if (bytes > free)
    throw SystemError(format("{}: the disk is full: the products take {}, {} free", target.string(),
                             byte_count(bytes), byte_count(free)));
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace ifov::io
