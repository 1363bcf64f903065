#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "io/envi/cube_layout.h"
#include "sampling/pixel_rect.h"

namespace ifov::io {

/// The values of a tile in a cube of floats, as [pixel * bands + band], where `read_at` reads the cube's file.
void read_cube_tile(const std::function<void(std::uint64_t offset, void* to, std::size_t bytes)>& read_at,
                    const CubeLayout& layout, sampling::PixelRect tile, std::span<float> values);

}  // namespace ifov::io
