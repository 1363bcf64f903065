#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ifov::io {

/// What a raster is without its numbers, and where it lies. A number stands for the middle of its cell, also in
/// files that say that their pixels are points: their georeference is moved by half a cell.
struct RasterFrame {
  int width = 0, height = 0, bands = 0;
  /// Map coordinates: x = t[0] + column t[1] + row t[2], y = t[3] + column t[4] + row t[5]; none: a bare
  /// picture.
  std::optional<std::array<double, 6>> geotransform;
  std::string projection;  ///< WKT; empty where the file has none

  std::size_t cells() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// A raster in memory: bands of height x width numbers, rows from the top.
struct Raster : RasterFrame {
  std::vector<float> values;       ///< [(band * height + row) * width + column]
  std::optional<double> nodata;    ///< of the first band that has one
  std::vector<std::string> units;  ///< of each band's numbers, as the file says; mostly empty

  float at(int band, int row, int column) const {
    return values[(static_cast<std::size_t>(band) * static_cast<std::size_t>(height) +
                   static_cast<std::size_t>(row)) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

/// Names of GDAL's drivers that are tried, for people.
std::string raster_driver_list();

/// Reads all bands of a raster by GDAL, as floats: any kind in raster_driver_list(). A palette's indices count, not
/// its colours; a band's scale and offset are applied. No other driver is tried (none that reads further files), and
/// no path into GDAL's virtual file systems is followed. A raster of more than `max_values` numbers is refused before
/// memory is taken. Throws InputError where the file is not such a raster or is damaged, SystemError
/// where it is not there.
Raster read_raster(const std::filesystem::path& path, std::size_t max_values = std::size_t{1} << 28);

/// The same of one band, from 1, which is then the only one. Throws InputError where the file has fewer.
Raster read_band(const std::filesystem::path& path, int band, std::size_t max_values = std::size_t{1} << 28);

/// What the file says of itself; its numbers are not read.
RasterFrame read_raster_frame(const std::filesystem::path& path);

}  // namespace ifov::io
