#include "io/files/own_files.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <string_view>

#include "core/error.h"
#include "io/files/file_reasons.h"

namespace ifov::io {
namespace {

namespace fs = std::filesystem;

SystemError cannot_write(const fs::path& path, int error) {
  return SystemError(format("{}: cannot be written: {}", path.string(), file_reason(error)));
}

}  // namespace

void refuse_link(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(folder, error))) return;
  throw SystemError(format(
      "'{}' is a link (to '{}'), and ifov writes through no link that lies beside a document or in its output "
      "folder; delete the link, or say where to write (--output)",
      folder.string(), fs::read_symlink(folder, error).string()));
}

void refuse_links_below(const fs::path& trusted, const fs::path& folder) {
  fs::path place = trusted;
  for (const fs::path& name :
       folder.lexically_normal().lexically_relative(trusted.empty() ? "." : trusted.lexically_normal())) {
    place /= name;
    if (name != "." && !name.empty()) refuse_link(place);
  }
}

Descriptor create_file_at(int folder, const fs::path& name) {
  constexpr int kAttempts = 5;  // another program may make a file of this name in between
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Descriptor file(openat(folder, name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (file || errno != EEXIST) return file;
    if (unlinkat(folder, name.c_str(), 0) != 0 && errno != ENOENT) return Descriptor();
  }
  errno = EEXIST;
  return Descriptor();
}

OwnFile::OwnFile(const fs::path& path)
    : path_(path), file_(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)) {
  struct stat info {};
  if (file_ && (fstat(file_.number(), &info) != 0 || !S_ISREG(info.st_mode))) file_.reset();
}

void read_whole(const Descriptor& file, const fs::path& path, std::uint64_t offset, void* to,
                std::size_t bytes) {
  auto* into = static_cast<char*>(to);
  while (bytes > 0) {
    const ssize_t got = pread(file.number(), into, bytes, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      throw SystemError(format("{}: cannot be read at byte {}: {}", path.string(), offset,
                               got < 0 ? file_reason(errno) : "the file ends"));
    into += got;
    offset += static_cast<std::uint64_t>(got);
    bytes -= static_cast<std::size_t>(got);
  }
}

std::string read_own_file(const fs::path& path) {
  const auto fail = [&](const std::string& why) {
    return SystemError(format("{}: cannot be read: {}", path.string(), why));
  };
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file) throw fail(errno == ELOOP ? "it is a link" : file_reason(errno));
  struct stat info {};
  if (fstat(file.number(), &info) != 0 || !S_ISREG(info.st_mode)) throw fail("it is not a plain file");
  std::string text;
  for (char bytes[65536];;) {
    const ssize_t got = read(file.number(), bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw fail(file_reason(errno));
    if (got == 0) return text;
    text.append(bytes, static_cast<std::size_t>(got));
  }
}

NewFile::NewFile(fs::path path, fs::path part_path)
    : path_(std::move(path)), part_path_(std::move(part_path)), file_(create_file_at(AT_FDCWD, part_path_)) {
  if (!file_) throw cannot_write(part_path_, errno);
}

NewFile::~NewFile() {
  if (!published_) unlink(part_path_.c_str());
}

void NewFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(file_.number(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw cannot_write(part_path_, written < 0 ? errno : ENOSPC);
    offset += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void NewFile::append(std::span<const std::byte> bytes) {
  write_at(size_, bytes);
  size_ += bytes.size();
}

void NewFile::write_head(std::span<const std::byte> bytes) { write_at(0, bytes); }

void NewFile::publish() {
  if (std::rename(part_path_.c_str(), path_.c_str()) != 0) throw cannot_write(path_, errno);
  published_ = true;
  file_.reset();
}

void write_new_file(const fs::path& path, std::string_view content) {
  fs::path part = path;
  part += ".part";
  NewFile file(path, part);
  file.append(std::as_bytes(std::span(content)));
  file.publish();
}

}  // namespace ifov::io
