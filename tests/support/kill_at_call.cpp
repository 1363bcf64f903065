// Preloaded into a program (LD_PRELOAD): the n-th call of it that changes files is its last, as if the power
// failed. IFOV_KILL_AT gives n, from 1; IFOV_COUNT_CALLS names a file that gets the number of calls at the
// end.

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> calls{0};

bool is_last() {
  static const long last = [] {
    const char* text = std::getenv("IFOV_KILL_AT");
    return text != nullptr ? std::atol(text) : 0L;
  }();
  return ++calls == last;
}

void end() { kill(getpid(), SIGKILL); }

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

struct Report {
  ~Report() {
    const char* name = std::getenv("IFOV_COUNT_CALLS");
    FILE* file = name != nullptr ? std::fopen(name, "w") : nullptr;
    if (file == nullptr) return;
    std::fprintf(file, "%ld\n", calls.load());
    std::fclose(file);
  }
} report;

}  // namespace

extern "C" {

int rename(const char* from, const char* to) {
  if (is_last()) end();
  return next<int(const char*, const char*)>("rename")(from, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  if (is_last()) end();
  return next<int(int, const char*, int, const char*)>("renameat")(from_folder, from, to_folder, to);
}

int unlink(const char* path) {
  if (is_last()) end();
  return next<int(const char*)>("unlink")(path);
}

int unlinkat(int folder, const char* path, int flags) {
  if (is_last()) end();
  return next<int(int, const char*, int)>("unlinkat")(folder, path, flags);
}

int remove(const char* path) {
  if (is_last()) end();
  return next<int(const char*)>("remove")(path);
}

int ftruncate(int file, off_t size) {
  if (is_last()) end();
  return next<int(int, off_t)>("ftruncate")(file, size);
}

int fdatasync(int file) {
  if (is_last()) end();
  return next<int(int)>("fdatasync")(file);
}

ssize_t pwrite(int file, const void* data, size_t bytes, off_t offset) {
  auto* call = next<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  if (is_last()) {
    call(file, data, bytes / 2, offset);  // a write that is cut short
    end();
  }
  return call(file, data, bytes, offset);
}

ssize_t pwritev(int file, const iovec* pieces, int count, off_t offset) {
  if (is_last()) {
    auto* write_half = next<ssize_t(int, const void*, size_t, off_t)>("pwrite");
    for (int k = 0; k < (count + 1) / 2; ++k) {
      const size_t bytes = count == 1 ? pieces[k].iov_len / 2 : pieces[k].iov_len;
      write_half(file, pieces[k].iov_base, bytes, offset);
      offset += static_cast<off_t>(bytes);
    }
    end();
  }
  return next<ssize_t(int, const iovec*, int, off_t)>("pwritev")(file, pieces, count, offset);
}

int fallocate(int file, int mode, off_t offset, off_t size) {
  if (is_last()) end();
  return next<int(int, int, off_t, off_t)>("fallocate")(file, mode, offset, size);
}

}  // extern "C"
