#pragma once

#include <cstdint>
#include <string>

namespace ifov {

/// "812 bytes", "72.0 GB".
std::string byte_count(std::uint64_t bytes);

}  // namespace ifov
