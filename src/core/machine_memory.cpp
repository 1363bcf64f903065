#include "core/machine_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "core/byte_count.h"
#include "core/format.h"

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

/// The most that this process may map (`ulimit -v`).
std::optional<std::uint64_t> mapped_limit_bytes() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

}  // namespace

std::uint64_t peak_memory_bytes() { return kilobytes_in("/proc/self/status", "VmHWM:"); }

std::uint64_t resident_memory_bytes() { return kilobytes_in("/proc/self/status", "VmRSS:"); }

std::uint64_t memory_within_reach_bytes() {
  std::uint64_t most = kilobytes_in("/proc/meminfo", "MemAvailable:");
  if (most == 0) most = std::numeric_limits<std::uint64_t>::max() / 2;
  if (const std::optional<std::uint64_t> limit = mapped_limit_bytes()) {
    const std::uint64_t mapped = kilobytes_in("/proc/self/status", "VmSize:");
    most = std::min(most, *limit - std::min(*limit, mapped));
  }
  most += resident_memory_bytes();
  std::uint64_t group = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> group) most = std::min(most, group);
  return most;
}

std::string memory_ran_out() {
  const std::string held = format("memory ran out: {} were held at most", byte_count(peak_memory_bytes()));
  if (const std::optional<std::uint64_t> limit = mapped_limit_bytes())
    return format(
        "{}, and no more than {} may be mapped (ulimit -v); fewer threads or smaller tiles take less", held,
        byte_count(*limit));
  return format("{}; fewer threads or smaller tiles take less", held);
}

}  // namespace ifov
