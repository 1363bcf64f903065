// Compiled for any x86-64 (see CMakeLists.txt), and run before all initialization of code that is not.
#include <unistd.h>

#include <cstring>

namespace {

void put(const char* text) {
  const ssize_t ignored = write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(ignored);
}

__attribute__((constructor(101))) void refuse_old_processor() {
  __builtin_cpu_init();
  const char* missing = nullptr;
#define IFOV_NEEDS(feature) \
  if (missing == nullptr && !__builtin_cpu_supports(#feature)) missing = #feature;
  IFOV_PROCESSOR_NEEDS
#undef IFOV_NEEDS
  if (missing == nullptr) return;
  put("ifov: this processor lacks ");
  put(missing);
  put(", and this ifov was built for " IFOV_MARCH
      ": take a newer one, or build with -DIFOV_MARCH=native on this machine\n");
  _exit(2);
}

}  // namespace
