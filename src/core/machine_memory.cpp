#include "core/machine_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace ifov {
namespace {

/// The number of a line such as "VmHWM:   1234 kB" of a file under /proc, in bytes; 0 where there is none.
std::uint64_t kilobytes_in(const char* file, const std::string& name) {
  std::ifstream stream(file);
  std::string word;
  std::uint64_t number = 0;
  while (stream >> word)
    if (word == name && stream >> number) return 1024 * number;
  return 0;
}

}  // namespace

std::uint64_t peak_memory_bytes() { return kilobytes_in("/proc/self/status", "VmHWM:"); }

std::uint64_t resident_memory_bytes() { return kilobytes_in("/proc/self/status", "VmRSS:"); }

std::uint64_t memory_within_reach_bytes() {
  std::uint64_t most = kilobytes_in("/proc/meminfo", "MemAvailable:");
  if (most == 0) most = std::numeric_limits<std::uint64_t>::max() / 2;
  most += kilobytes_in("/proc/self/status", "VmRSS:");
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    most = std::min<std::uint64_t>(most, limit.rlim_cur);
  std::uint64_t group = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> group) most = std::min(most, group);
  return most;
}

}  // namespace ifov
