#pragma once

#include <cstdint>

namespace ifov::sampling {

/// Where a number of the label table stands for none.
constexpr std::uint32_t kNoLabel = ~std::uint32_t{0};

}  // namespace ifov::sampling
