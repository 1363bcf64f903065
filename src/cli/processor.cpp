// Compiled for any x86-64 (see CMakeLists.txt), and run before all initialization of code that is not.
#include <unistd.h>

namespace {

__attribute__((constructor(101))) void refuse_old_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return;
  const char message[] =
      "ifov: this processor lacks AVX2, FMA or BMI2; ifov needs x86-64-v3 (Intel Haswell, AMD Excavator or later)\n";
  const ssize_t ignored = write(STDERR_FILENO, message, sizeof message - 1);
  static_cast<void>(ignored);
  _exit(2);
}

}  // namespace
