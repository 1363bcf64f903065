#include "core/late_library.h"

#include <dlfcn.h>

#include "core/error.h"

namespace ifov {

void* LateLibrary::function(const char* name) {
  void* handle = handle_.load(std::memory_order_acquire);
  if (handle == nullptr) {
    // The loader counts who asks for a library and loads it once. Its own names stay out of the way of a program's.
    handle = dlopen(file_, RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr)
      throw SystemError(
          format("the library {} cannot be loaded: {}; it was there when ifov was built", file_, dlerror()));
    handle_.store(handle, std::memory_order_release);
  }
  void* const address = dlsym(handle, name);
  if (address == nullptr)
    throw SystemError(
        format("the library {} has no function {}; ifov was built with another version of it", file_, name));
  return address;
}

}  // namespace ifov
