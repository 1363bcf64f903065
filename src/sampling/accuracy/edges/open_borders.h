#pragma once

#include <cstdint>
#include <vector>

namespace ifov::sampling {

/// Cells whose borders are to be verified.
struct OpenBorders {
  std::vector<std::uint32_t> curves, junctions;
};

}  // namespace ifov::sampling
