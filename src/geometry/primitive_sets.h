#pragma once

#include <cstdint>
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
  std::vector<std::uint32_t> owners;

  // For Embree; given away when its geometry is made.
  std::vector<float> vertices_m;
  std::vector<Triangle> triangles;

  void append(const Body& body, const math::Transform& set_from_object);
};

struct AnalyticSet {
  std::vector<UnitPrimitive> shapes;  ///< `unit_from_object` leads from the set's frame
  std::vector<std::uint32_t> owners;
  double padding_m = 0.0;  ///< by which bounds are widened against Embree's rounding

  void append(const Body& body, const math::Transform& set_from_object);
};

}  // namespace ifov::geometry
