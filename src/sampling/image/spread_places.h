#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/pixel_rect.h"

namespace ifov::sampling {

/// A pixel.
struct Place {
  int i, j;
};

/// All pixels of an image of at most so many; else as many that lie evenly over it, each of them anywhere with the same chance: the
/// sequence R2 of Roberts (2018), "The unreasonable effectiveness of quasirandom sequences", moved at random.
std::vector<Place> spread_places(const PixelRect& image, std::size_t count, std::uint64_t key);

}  // namespace ifov::sampling
