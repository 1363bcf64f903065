#include "core/byte_count.h"

#include "core/format.h"

namespace ifov {

std::string byte_count(std::uint64_t bytes) {
  if (bytes < 10000) return format("{} bytes", bytes);
  const double b = static_cast<double>(bytes);
  if (b < 1e7) return format("{:.1f} kB", b / 1e3);
  if (b < 1e10) return format("{:.1f} MB", b / 1e6);
  if (b < 1e13) return format("{:.1f} GB", b / 1e9);
  return format("{:.1f} TB", b / 1e12);
}

}  // namespace ifov
