#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

namespace ifov {

/// The one place where text is formatted (GCC 12 has no <format>).
template <class... Args>
std::string format(fmt::format_string<Args...> pattern, Args&&... args) {
  return fmt::format(pattern, std::forward<Args>(args)...);
}

}  // namespace ifov
