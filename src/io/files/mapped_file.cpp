#include "io/files/mapped_file.h"

#include <sys/mman.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/printable.h"
#include "io/files/file_reasons.h"
#include "io/files/input_file.h"

namespace ifov::io {
namespace {

/// What a signal handler may read while files come and go. A file that finds no place is mapped all the same.
struct Listed {
  std::atomic<bool> taken{false};
  std::atomic<const std::byte*> begin{nullptr};
  std::atomic<std::size_t> size{0};
  std::array<char, 512> name{};
};
std::array<Listed, 256> listed;

int enter(const std::byte* data, std::size_t size, const std::filesystem::path& path) {
  for (std::size_t k = 0; k < listed.size(); ++k) {
    Listed& one = listed[k];
    if (one.taken.exchange(true)) continue;
    const std::string name = printable(path.string());
    one.name.fill('\0');
    std::memcpy(one.name.data(), name.data(), std::min(name.size(), one.name.size() - 1));
    one.size = size;
    one.begin = data;
    return static_cast<int>(k);
  }
  return -1;
}

}  // namespace

const char* mapped_file_at(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (const Listed& one : listed) {
    const auto begin = reinterpret_cast<std::uintptr_t>(one.begin.load());
    if (begin != 0 && at >= begin && at - begin < one.size.load()) return one.name.data();
  }
  return nullptr;
}

MappedFile::MappedFile(const std::filesystem::path& path) {
  const InputFile file(path);
  size_ = file.size();
  if (size_ == 0) return;
  if (file.memory()) {
    memory_ = file.memory();
    data_ = reinterpret_cast<const std::byte*>(memory_->data());
    return;
  }
  void* memory = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
  if (memory == MAP_FAILED)
    throw SystemError(format("cannot read '{}': {}", path.string(), file_reason(errno)));
  data_ = static_cast<const std::byte*>(memory);
  place_ = enter(data_, size_, path);
}

MappedFile::~MappedFile() {
  if (place_ >= 0) {
    Listed& one = listed[static_cast<std::size_t>(place_)];
    one.begin = nullptr;
    one.taken = false;
  }
  if (data_ != nullptr && !memory_) munmap(const_cast<std::byte*>(data_), size_);
}

}  // namespace ifov::io
