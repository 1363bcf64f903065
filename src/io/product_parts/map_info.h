#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/tile_sink.h"

namespace ifov::io {

/// Map coordinates of image point (x, y): {g0 + x g1 + y g2, g3 + x g4 + y g5}, as GDAL counts.
std::array<double, 6> geotransform(const render::ImageInfo& info);

/// Well-known text of info.map_projection ("EPSG:32633" or well-known text); empty for "Arbitrary" and
/// nothing. ifov::InputError on text that names no coordinate system.
std::string coordinate_system_text(const render::ImageInfo& info);

/// The same in its second version (ISO 19162).
std::string wkt2_text(const render::ImageInfo& info);

/// The same in ESRI's dialect, which is that of ENVI headers.
std::string esri_coordinate_system_text(const render::ImageInfo& info);

/// A coordinate system as a run record states it.
struct MapSystem {
  std::string name, wkt;
  int epsg = 0;  ///< 0: it has no code
};
MapSystem map_system(const render::ImageInfo& info);

/// The items of an ENVI header's "map info".
std::vector<std::string> envi_map_info(const render::ImageInfo& info);

}  // namespace ifov::io
