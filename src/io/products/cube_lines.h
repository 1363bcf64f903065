#pragma once

#include <cstddef>
#include <span>

#include "io/envi/cube_layout.h"

namespace ifov::io {

class PartFile;

/// Writes whole lines of a cube from line `first` on, told as [line][band][sample], to where its layout has them. From any thread.
void write_cube_lines(PartFile& file, const CubeLayout& layout, std::size_t value_bytes, int first,
                      std::span<const std::byte> lines);

/// The same of one line's bands from `first_band` on. By pixel the line is read and written again, so that lines may not be shared by threads.
void write_cube_bands(PartFile& file, const CubeLayout& layout, std::size_t value_bytes, int line,
                      int first_band, std::span<const std::byte> values);

}  // namespace ifov::io
