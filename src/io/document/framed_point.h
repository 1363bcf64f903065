#pragma once

#include <array>

namespace ifov::io {

/// Of the scene: its east, north, up about its origin, in the document's coordinates. Geodetic: longitude, latitude, height above
/// the ellipsoid WGS 84. ECEF: Earth-centred, Earth-fixed.
enum class PathFrame { scene, geodetic, ecef };

/// A place in a frame: metres; geodetic: longitude and latitude in radians, height.
struct FramedPoint {
  PathFrame frame = PathFrame::scene;
  std::array<double, 3> place{};
};

}  // namespace ifov::io
