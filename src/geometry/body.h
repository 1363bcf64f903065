#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shapes.h"
#include "geometry/unit_primitive.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// What one placed object consists of, in its own frame: analytic shapes and one triangle mesh. Primitives
/// are numbered analytic shapes first, then triangles; patches likewise.
struct Body {
  std::vector<UnitPrimitive> analytic;
  TriangleMesh mesh;
  std::vector<std::uint32_t> mesh_patches;  ///< per triangle
  std::uint32_t patch_count = 0;
  std::size_t surface_triangles = 0;  ///< in meshes that are surfaces rather than heaps of small things
  std::uint32_t slot_count = 1;
  World::Bounds bounds{};
  math::Point3 centre_m;  ///< of the bounding sphere
  double radius_m = 0.0;
  math::Point3 seed_m;       ///< a point in a solid, or on a face
  double seed_weight = 0.0;  ///< what the seed stands for: area of the face, or of the ball about a solid
  bool seed_is_solid = false;
};

/// A body of one shape (not a plane). Throws InputError for sizes, polygons or indices that make no sense.
Body body_of(Shape shape);

/// Throws InputError unless every index is within its list, lists have equal lengths where they must, and vertices
/// are finite.
void check_mesh(const TriangleMesh& mesh);

/// A body of another one's copy: adds `part` moved and with its slots renamed.
void append_part(Body& whole, const Body& part, const math::Transform& whole_from_part,
                 std::span<const std::uint32_t> slots);

/// Bounds and bounding sphere, once all parts are in.
void settle_bounds(Body& body);

}  // namespace ifov::geometry
