#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "math/vec3.h"

namespace ifov::io {

/// Where the scene stands. Coordinates of the document and of its files are metres east, north and up of a
/// point; `offset_m` (map easting, northing and height of the scene's own origin, zero without a map origin)
/// is to be subtracted from them, in double, except inside prototypes.
struct OriginDocument {
  struct Geographic {
    double latitude_rad = 0.0, longitude_rad = 0.0;  ///< WGS 84, north and east positive
  };
  std::optional<Geographic> geographic;
  std::string crs;  ///< of map coordinates, as PROJ knows it; may be empty
  SourcePosition crs_position;
  bool has_map_offset = false;
  math::Vec3 offset_m;
  double height_m = 0.0;  ///< of the scene's origin above the ellipsoid
  SourcePosition position;
};

}  // namespace ifov::io
