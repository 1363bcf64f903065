#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/body.h"
#include "geometry/unit_primitive.h"
#include "math/transform.h"

namespace ifov::geometry {

/// The plane of a triangle, normal . p = offset_m; the normal is outward and has length 1, or 0 where the
/// triangle has no area.
struct Facet {
  math::Vec3 normal;
  double offset_m = 0.0;
};
struct FacetTag {
  std::uint32_t patch = 0;
  std::uint32_t slot = 0;
};

/// What is known in double of the triangles and analytic shapes of one Embree geometry, by Embree's primitive
/// number, in the frame of the set: a body's own, moved so that its centre is the origin, or the scene's
/// about its centre. In the latter several pieces share the set and `owners` says which primitive is whose.
struct TriangleSet {
  std::vector<Facet> facets;
  std::vector<FacetTag> tags;
  std::vector<std::uint32_t> owners;  ///< empty: all are the only owner's
  std::uint32_t only_owner = 0;
  std::span<const std::uint32_t> numbers;  ///< of a chunk's triangles in their body; empty: as in the set

  std::uint32_t owner(std::uint32_t prim) const { return owners.empty() ? only_owner : owners[prim]; }
  std::uint32_t number(std::uint32_t prim) const { return numbers.empty() ? prim : numbers[prim]; }
  /// That stay when Embree has its own.
  std::size_t bytes() const {
    return facets.capacity() * sizeof(Facet) + tags.capacity() * sizeof(FacetTag) +
           owners.capacity() * sizeof(std::uint32_t);
  }

  // For Embree; given away when its geometry is made.
  std::vector<float> vertices_m;
  std::vector<Triangle> triangles;

  void append(const Body& body, const math::Transform& set_from_object);
  /// Some triangles of a mesh, each with its number, into an empty set.
  void take(const MeshLists& mesh, std::span<const std::uint32_t> triangles_of_mesh,
            const math::Transform& set_from_object);

 private:
  void add(const MeshLists& mesh, std::size_t triangle, math::Point3 a, math::Point3 b, math::Point3 c,
           bool flipped, const Triangle& corners);
};

struct AnalyticSet {
  std::vector<UnitPrimitive> shapes;  ///< `unit_from_object` leads from the set's frame
  std::vector<std::uint32_t> owners;
  double padding_m = 0.0;  ///< by which bounds are widened against Embree's rounding

  void append(const Body& body, const math::Transform& set_from_object);
};

}  // namespace ifov::geometry
