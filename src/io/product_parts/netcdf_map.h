#pragma once

#include "render/tile_sink.h"

namespace ifov::io {

/// Where an image lies on the map, in a NetCDF file: coordinates x and y of the pixels' middles where the image is not
/// turned, and the grid mapping with well-known text and GDAL's "GeoTransform" where the system is known.
class NetcdfMap {
 public:
  static constexpr const char* kName = "crs";  ///< of the grid mapping

  /// While the file is being defined, which has these dimensions. ifov::SystemError in the library's words.
  static NetcdfMap define(int file, int y_dimension, int x_dimension, const render::ImageInfo& info);
  bool has_system() const { return system_ >= 0; }
  void write(int file, const render::ImageInfo& info) const;

 private:
  int x_ = -1, y_ = -1, system_ = -1;
};

}  // namespace ifov::io
