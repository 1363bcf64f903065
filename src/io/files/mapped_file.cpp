#include "io/files/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace ifov::io {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const auto fail = [&](const char* why) {
    return EnvironmentError(format("cannot read '{}': {}", path.string(), why));
  };
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) throw fail(std::strerror(errno));
  struct stat info {};
  const char* why = nullptr;
  if (fstat(descriptor, &info) != 0)
    why = std::strerror(errno);
  else if (S_ISDIR(info.st_mode))
    why = "it is a folder";
  else if (!S_ISREG(info.st_mode))
    why = "it is not a plain file";
  if (why == nullptr && info.st_size > 0) {
    size_ = static_cast<std::size_t>(info.st_size);
    void* memory = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (memory == MAP_FAILED)
      why = std::strerror(errno);
    else
      data_ = static_cast<const std::byte*>(memory);
  }
  close(descriptor);
  if (why != nullptr) throw fail(why);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(const_cast<std::byte*>(data_), size_);
}

}  // namespace ifov::io
