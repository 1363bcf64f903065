#pragma once

#include <atomic>

namespace ifov {

/// A shared library that is loaded when one of its functions is first called. GDAL brings a hundred others: loading them takes longer
/// than a small document does, and most documents need none of it.
///
/// Threads may share it. It stays loaded.
class LateLibrary {
 public:
  /// `file` as the system's loader looks for it, such as "libz.so.1" (cmake/LateLibrary.cmake asks the library that is built with).
  explicit constexpr LateLibrary(const char* file) : file_(file) {}

  /// The address of a function. Throws SystemError where the library cannot be loaded or has no such function.
  void* function(const char* name);

 private:
  const char* file_;
  std::atomic<void*> handle_{nullptr};
};

/// A function of such a library: called and handed on like one, by what its header declares.
///
///   inline LateFunction<decltype(&::GDALOpenEx)> GDALOpenEx{library, "GDALOpenEx"};
template <class Pointer>
class LateFunction {
 public:
  constexpr LateFunction(LateLibrary& library, const char* name) : library_(library), name_(name) {}

  operator Pointer() {
    void* found = address_.load(std::memory_order_acquire);
    if (found == nullptr) {
      found = library_.function(name_);
      address_.store(found, std::memory_order_release);
    }
    return reinterpret_cast<Pointer>(found);
  }

 private:
  LateLibrary& library_;
  const char* name_;
  std::atomic<void*> address_{nullptr};
};

}  // namespace ifov
