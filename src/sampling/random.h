#pragma once

#include <cstdint>

#include "sampling/hash.h"

namespace ifov::sampling {

/// A point of the unit square [0, 1) x [0, 1).
struct Point2 {
  double x = 0.0, y = 0.0;
};

/// The random number of a key, in [0, 1) with 53 bits.
constexpr double unit_double(std::uint64_t key) { return static_cast<double>(mix(key) >> 11) * 0x1p-53; }

}  // namespace ifov::sampling
