#pragma once

#include <cstddef>

namespace ifov::io {

/// Turns one row of a tile: 4-byte values [pixel][band] at `from` become [band][pixel] at `to`, whose band
/// rows are `to_stride` values apart. Blocks of 8 x 8 are turned in registers; values of other sizes one by one.
void turn_bands(const void* from, std::size_t pixels, std::size_t bands, void* to, std::size_t to_stride,
                std::size_t value_bytes = 4);

}  // namespace ifov::io
