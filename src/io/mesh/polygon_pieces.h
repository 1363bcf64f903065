#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace ifov::io {

/// Why cut_face returns nothing.
inline constexpr const char* kCrossesItself = "the outline of this face crosses itself";

/// Cuts the face of a mesh file, convex or not, into triangles that index its corners. Faces of up to a
/// thousand corners always yield corners - 2 triangles (see geometry::triangulate_polygon); larger ones must
/// not cross themselves, else the result is empty.
std::optional<std::vector<geometry::Triangle>> cut_face(std::span<const math::Point3> corners);

/// A polygon with holes as triangles.
struct PolygonPieces {
  /// Those of the rings one after another, then new ones where rings cross.
  std::vector<math::Point3> vertices;
  std::vector<geometry::Triangle> triangles;  ///< wound like the outer ring
  bool repaired = false;                      ///< rings crossed themselves or each other
};

/// Cuts a polygon into triangles by constrained Delaunay triangulation (GEOS) in the coordinate plane in
/// which its outer ring is largest: rings[0] is the outer ring, the others are holes; the first vertex of a
/// ring is not repeated at its end, the windings of holes do not matter. Rings that cross are first made
/// valid. A polygon without area yields no triangles; nothing is returned where GEOS fails.
std::optional<PolygonPieces> cut_polygon(std::span<const std::vector<math::Point3>> rings);

}  // namespace ifov::io
