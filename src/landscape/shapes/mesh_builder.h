#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "math/transform.h"

namespace ifov::landscape {

using math::Point3;
using math::Vec3;

/// Collects triangles with named material slots. Coordinates are metres in the current frame; faces are
/// counter-clockwise when seen from outside.
class MeshBuilder {
 public:
  /// Material slot of what follows.
  void slot(std::string_view name);
  /// Frame of what follows.
  void frame(const math::Transform& mesh_from_part) { mesh_from_part_ = mesh_from_part; }

  void triangle(Point3 a, Point3 b, Point3 c);
  void quad(Point3 a, Point3 b, Point3 c, Point3 d);
  /// A flat polygon without holes, which may be concave.
  void polygon(std::span<const Point3> vertices_m);
  void box(Point3 low_m, Point3 high_m);
  /// A tube of `sides` faces along a polyline, with a radius at each of its points; ends closed where asked.
  void tube(std::span<const Point3> axis_m, std::span<const double> radii_m, int sides, bool closed_ends);
  void tube(Point3 from_m, Point3 to_m, double radius_m, int sides);
  /// Faces (counter-clockwise from above) as a slab `thickness_m` thick, measured downwards: tops, undersides
  /// and strips along edges that no two faces share.
  void slab(std::span<const std::vector<Point3>> faces, double thickness_m);

  bool empty() const { return mesh_.triangles.empty(); }
  geometry::TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(Point3 p);

  geometry::TriangleMesh mesh_;
  math::Transform mesh_from_part_;
  std::uint32_t slot_ = 0;
};

}  // namespace ifov::landscape
