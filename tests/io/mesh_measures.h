#pragma once

#include <algorithm>

#include "geometry/triangle_mesh.h"

namespace ifov::test {

/// Bounds of the vertices (those no triangle uses too), area and signed volume of a mesh.
struct MeshMeasures {
  double area = 0.0, volume = 0.0;
  math::Point3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
};

inline MeshMeasures measures_of(const geometry::TriangleMesh& mesh) {
  MeshMeasures m;
  for (const math::Point3& p : mesh.vertices_m) {
    m.low = {std::min(m.low.x, p.x), std::min(m.low.y, p.y), std::min(m.low.z, p.z)};
    m.high = {std::max(m.high.x, p.x), std::max(m.high.y, p.y), std::max(m.high.z, p.z)};
  }
  for (const geometry::Triangle& t : mesh.triangles) {
    const math::Point3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]], c = mesh.vertices_m[t[2]];
    m.area += 0.5 * length(cross(b - a, c - a));
    m.volume += dot(a - math::Point3{}, cross(b - math::Point3{}, c - math::Point3{})) / 6.0;
  }
  return m;
}

}  // namespace ifov::test
