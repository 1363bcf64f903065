#pragma once

#include <array>

#include "io/document/document_values.h"

namespace ifov::io {

/// Of the scene: its east, north, up about its origin, in the document's coordinates. Geodetic: longitude, latitude, height above
/// the ellipsoid WGS 84. Of a map: easting, northing, height. ECEF: Earth-centred, Earth-fixed. TEME and GCRS: Earth-centred, fixed among the stars.
enum class PathFrame { scene, geodetic, map, ecef, teme, gcrs };

/// Whether places in it are about the Earth, and not on the flat scene or its map.
constexpr bool is_about_earth(PathFrame frame) {
  return frame != PathFrame::scene && frame != PathFrame::map;
}
constexpr bool is_among_stars(PathFrame frame) {
  return frame == PathFrame::teme || frame == PathFrame::gcrs;
}

/// A place in a frame: metres; geodetic: longitude and latitude in radians, height.
struct FramedPoint {
  PathFrame frame = PathFrame::scene;
  std::array<double, 3> place{};
  DocumentName crs = {};  ///< of a map, as PROJ knows it; empty: the origin's
};

}  // namespace ifov::io
