#include "io/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/error.h"
#include "io/files/file_reasons.h"
#include "io/files/inputs.h"

namespace ifov::io {
namespace {

namespace fs = std::filesystem;

SystemError cannot_read(const fs::path& path, const std::string& why) {
  return SystemError(format("cannot read '{}': {}", path.string(), why));
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

SystemError lies_elsewhere(const fs::path& path) {
  return cannot_read(path, format("it does not lie below '{}', and --inputs-below allows no other files",
                                  current_inputs().below.string()));
}

/// Where an open file lies, whatever its name was; no race between the look and the reading can change that.
fs::path place_of(const Descriptor& file) {
  std::error_code unknown;
  return fs::read_symlink(format("/proc/self/fd/{}", file.number()), unknown);
}

int open_for_reading(const fs::path& path) {
  // A pipe does not make us wait for its writer.
  constexpr int kFlags = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK;
  if (current_inputs().below.empty()) return open(path.c_str(), kFlags);
  // Looked at before it is opened: to open a device may do something.
  const Descriptor place(open(path.c_str(), O_PATH | O_CLOEXEC));
  if (!place) {
    const int error = errno;
    std::error_code unknown;
    if (!is_below(fs::weakly_canonical(path, unknown), current_inputs().below)) throw lies_elsewhere(path);
    errno = error;
    return -1;
  }
  if (!is_below(place_of(place), current_inputs().below)) throw lies_elsewhere(path);
  return open(format("/proc/self/fd/{}", place.number()).c_str(), kFlags);
}

}  // namespace

InputFile::InputFile(const fs::path& path) : path_(path) {
  if (is_asset_name(path.native())) {
    memory_ = asset_as<FileBytes>(path, "a file").bytes;
    size_ = memory_->size();
    return;
  }
  descriptor_ = Descriptor(open_for_reading(path));
  if (!descriptor_) throw cannot_read(path_, file_reason(errno));
  struct stat info {};
  if (fstat(descriptor_.number(), &info) != 0) throw cannot_read(path_, file_reason(errno));
  if (S_ISDIR(info.st_mode)) throw cannot_read(path_, "it is a folder");
  if (!S_ISREG(info.st_mode)) throw cannot_read(path_, "it is not a plain file");
  size_ = static_cast<std::uint64_t>(info.st_size);
}

std::size_t InputFile::read_at(std::uint64_t offset, std::span<char> bytes) const {
  if (memory_)
    return offset < size_ ? memory_->copy(bytes.data(), bytes.size(), static_cast<std::size_t>(offset)) : 0;
  std::size_t done = 0;
  while (done < bytes.size()) {
    stop_if_cancelled();
    constexpr std::size_t kPiece_bytes = std::size_t{16} << 20;
    const ssize_t got = pread(descriptor_.number(), bytes.data() + done,
                              std::min(bytes.size() - done, kPiece_bytes), static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw cannot_read(path_, file_reason(errno));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string InputFile::text() const {
  if (memory_) return *memory_;
  std::string text(size_, '\0');
  std::size_t done = read_at(0, text);
  // Some file systems (/proc, growing logs) hold more than they said.
  for (char more[4096]; done == text.size();) {
    const std::size_t got = read_at(done, more);
    if (got == 0) break;
    text.append(more, got);
    done += got;
  }
  text.resize(done);
  return text;
}

std::string read_input(const fs::path& path) { return InputFile(path).text(); }

}  // namespace ifov::io
