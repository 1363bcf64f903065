#include "io/run_state/run_lock.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>

#include "core/error.h"
#include "io/files/file_reasons.h"

namespace ifov::io {
namespace {

struct Holder {
  long process = 0;  ///< 0: the file says nothing
  std::string host;
};

std::string this_host() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "localhost";
}

Holder read_holder(int descriptor) {
  char text[512] = {};
  const ssize_t got = pread(descriptor, text, sizeof text - 1, 0);
  Holder holder;
  // A line without an end is that of a run which was killed as it wrote it.
  if (got > 0 && std::strchr(text, '\n') != nullptr)
    std::istringstream(text) >> holder.process >> holder.host;
  return holder;
}

bool is_alive(long process) { return kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM; }

/// The path still leads to the file that is open: a run that ended may have taken it away.
bool is_current(int descriptor, const std::filesystem::path& path) {
  struct stat open_file {
  }, named{};
  return fstat(descriptor, &open_file) == 0 && lstat(path.c_str(), &named) == 0 &&
         open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

/// What no run left here: a link, a pipe, or a file that has a second name elsewhere.
void remove_planted(const std::filesystem::path& path) {
  struct stat named {};
  if (lstat(path.c_str(), &named) == 0 && (!S_ISREG(named.st_mode) || named.st_nlink > 1))
    unlink(path.c_str());
}

SystemError busy(const std::filesystem::path& path, const Holder& holder) {
  return SystemError(
      format("{}: another run is at work in this folder: process {} on {}; wait for it, stop it, or "
             "take another folder (--output)",
             path.parent_path().string(), holder.process, holder.host));
}

}  // namespace

RunLock::RunLock(std::filesystem::path file, LogSink* log) : path_(std::move(file)) {
  while (true) {
    remove_planted(path_);
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
      throw SystemError(format("{}: cannot be written: {}", path_.string(), file_reason(errno)));
    const bool locked = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    const bool cannot_tell = !locked && errno != EWOULDBLOCK;  // a file system without locks
    const Holder holder = read_holder(descriptor_);
    if (locked && !is_current(descriptor_, path_)) {
      close(descriptor_);
      continue;
    }
    std::string why_not;
    if (!locked && !cannot_tell) why_not = busy(path_, holder).what();
    if (why_not.empty() && holder.process > 0) {
      if (holder.host != this_host())
        why_not = format(
            "{}: a run on another machine, process {} on {}, has not ended or was killed; where it is "
            "gone, delete {} and try again",
            path_.parent_path().string(), holder.process, holder.host, path_.string());
      else if (cannot_tell && is_alive(holder.process))
        why_not = busy(path_, holder).what();
      else if (log != nullptr)
        log->warn(format("{}: process {}, which was at work here, is gone: its lock is taken over",
                         path_.parent_path().string(), holder.process));
    }
    if (!why_not.empty()) {
      close(descriptor_);
      throw SystemError(why_not);
    }
    break;
  }
  const std::string text = format("{} {}\n", getpid(), this_host());
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, text.data(), text.size(), 0) < 0) {
    const int error = errno;
    close(descriptor_);
    throw SystemError(format("{}: cannot be written: {}", path_.string(), std::strerror(error)));
  }
}

RunLock::~RunLock() {
  unlink(path_.c_str());
  close(descriptor_);
}

std::string lock_holder(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return {};
  const Holder holder = read_holder(descriptor);
  close(descriptor);
  const bool gone = holder.host == this_host() && !is_alive(holder.process);
  return holder.process <= 0 || gone ? std::string()
                                     : format("process {} on {}", holder.process, holder.host);
}

}  // namespace ifov::io
