#pragma once

#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace ifov::geometry {

/// Cuts a simple polygon, convex or not, into vertices.size() - 2 triangles of the same winding, by clipping
/// ears in the plane that fits it best (Newell's normal). The triangles index into `vertices_m`. Polygons
/// that cross themselves still yield that many triangles, which then overlap. Fewer than three vertices yield
/// none.
std::vector<Triangle> triangulate_polygon(std::span<const math::Point3> vertices_m);

/// Twice the area of a polygon times its unit normal (Newell's method).
math::Vec3 polygon_area_vector(std::span<const math::Point3> vertices_m);

}  // namespace ifov::geometry
