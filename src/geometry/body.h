#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh_lists.h"
#include "geometry/oriented_extent.h"
#include "geometry/shapes.h"
#include "geometry/unit_primitive.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// What one placed object consists of, in its own frame: analytic shapes and one triangle mesh. Primitives
/// are numbered analytic shapes first, then triangles; patches likewise.
struct Body {
  std::vector<UnitPrimitive> analytic;
  MeshLists mesh;
  std::uint32_t patch_count = 0;
  std::size_t surface_triangles = 0;  ///< in meshes that are surfaces rather than heaps of small things
  std::uint32_t slot_count = 1;
  World::Bounds bounds{};
  math::Point3 centre_m;  ///< of the bounding sphere
  double radius_m = 0.0;
  HalfSides half_sides_m{};    ///< of the vertices' box where there is nothing but a mesh, else of `bounds`
  math::Point3 pilot_point_m;  ///< a point in a solid, or on a face
  double pilot_weight =
      0.0;  ///< what the pilot point stands for: area of the face, or of the ball about a solid
  bool pilot_is_solid = false;
};

/// A body of one shape (not a plane); a large mesh is divided. Throws InputError for sizes, polygons or indices that
/// make no sense.
Body body_of(Shape shape);

/// Throws InputError unless every index is within its list, lists have equal lengths where they must, and vertices
/// are finite. Patches and chunks are not looked at.
void check_mesh(const MeshLists& mesh);

/// Several bodies as one.
class JoinedBody {
 public:
  explicit JoinedBody(std::uint32_t slot_count) { whole_.slot_count = slot_count; }

  /// Adds a copy of `part` moved and with its slots renamed.
  void add(const Body& part, const math::Transform& whole_from_part, std::span<const std::uint32_t> slots);

  /// Once all parts are in.
  Body take() &&;

 private:
  Body whole_;  // without its mesh
  TriangleMesh mesh_;
  std::vector<std::uint32_t> patches_;
};

}  // namespace ifov::geometry
