#include "core/late_library.h"

#include <dlfcn.h>

#include <new>
#include <string>

#include "core/error.h"

namespace ifov {

void* LateLibrary::function(const char* name) {
  void* handle = handle_.load(std::memory_order_acquire);
  if (handle == nullptr) {
    // The loader counts who asks for a library and loads it once. Its own names stay out of the way of a program's.
    handle = dlopen(file_, RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr) {
      const std::string why = dlerror();
      // So the loader says that there was no memory for it (ulimit -v); where the system forbids it, it says that too.
      if (why.ends_with("failed to map segment from shared object") ||
          why.find("annot allocate memory") != std::string::npos)
        throw std::bad_alloc();
      throw SystemError(
          format("the library {} cannot be loaded: {}; it was there when ifov was built", file_, why));
    }
    handle_.store(handle, std::memory_order_release);
  }
  void* const address = dlsym(handle, name);
  if (address == nullptr)
    throw SystemError(
        format("the library {} has no function {}; ifov was built with another version of it", file_, name));
  return address;
}

}  // namespace ifov
