#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ifov::io {

/// A picture for people: red, green, blue and how opaque, bytes; red is the lowest byte. Rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> cells;
  bool has_alpha = false;  ///< else all cells are opaque (255)
};

/// Decodes the bytes of an image file of any kind in raster_driver_list(), by GDAL: bands of 8 or 16 bits (the latter are rounded to
/// 8), one (grey, or a palette, whose colours count), two (grey and alpha), three or four (red, green, blue, alpha). `name` is what
/// messages call it. Throws InputError where it is nothing of the kind, is damaged, or has more than `max_cells` cells.
Picture decode_picture(const std::string& bytes, const std::string& name,
                       std::size_t max_cells = std::size_t{1} << 28);

}  // namespace ifov::io
