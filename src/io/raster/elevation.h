#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ifov::io {

/// What becomes of cells without a height.
enum class UnknownHeights {
  holes,  ///< they stay NaN
  fill,   ///< see read_elevation
};

/// Heights of a digital elevation model at the middles of its cells, rows from the top.
struct Elevation {
  int width = 0, height = 0;
  std::vector<float> height_m;  ///< NaN: unknown
  std::size_t unknown = 0;      ///< cells without a height in the file
  bool filled = false;
  std::optional<std::array<double, 6>> geotransform;  ///< as in Raster: of corners, not of middles
  std::string projection;                             ///< WKT; empty where the file has none
};

/// Reads a band (from 1) of a raster as heights. `unit_m`: metres per unit of the numbers; none: as the file says,
/// metres where it says nothing. Unknown are the file's nodata value and whatever is not finite. They are filled as
/// fill_unknown() says. Throws InputError, also where no height is known or the unit is not one of length.
Elevation read_elevation(const std::filesystem::path& path, int band, std::optional<double> unit_m,
                         UnknownHeights unknown);

}  // namespace ifov::io
