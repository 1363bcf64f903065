#pragma once

#include <cstdint>

#include "sampling/random.h"

namespace ifov::sampling {

/// Where the grid of a bracket begins (Bracket::lay_grid).
class Dither {
 public:
  virtual ~Dither() = default;

  /// In steps: uniform in [0, 1), independent for unlike keys, the same in all tiles.
  virtual double phase(std::uint64_t key) const { return unit_double(key); }
};

}  // namespace ifov::sampling
