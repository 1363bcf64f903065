#pragma once

#include <cstdint>

#include "geometry/unit_kind.h"
#include "geometry/unit_shape.h"
#include "math/transform.h"

namespace ifov::geometry {

/// An analytic shape as it lies in an object: the affine map carries position, size and unequal scale.
struct UnitPrimitive {
  math::Transform unit_from_object;
  std::uint32_t patch = 0;  ///< of face 0 within the object; other faces follow
  std::uint32_t slot = 0;
  UnitKind kind = UnitKind::sphere;
};

// What a unit shape answers, see UnitShape.
inline UnitHit intersect_unit(UnitKind kind, math::Point3 p, math::Vec3 d, double t_min, double t_max) {
  return kind->intersect(p, d, t_min, t_max);
}
inline math::Normal3 unit_normal(UnitKind kind, std::uint32_t face, math::Point3 p) {
  return kind->normal(face, p);
}
inline Uv unit_uv(UnitKind kind, std::uint32_t face, math::Point3 p) { return kind->uv(face, p); }
inline std::uint32_t unit_face_count(UnitKind kind) { return kind->faces; }
inline bool is_round(UnitKind kind, std::uint32_t face) { return (kind->round_faces >> face & 1u) != 0; }
inline World::Bounds unit_bounds(UnitKind kind, const math::Transform& object_from_unit) {
  return kind->bounds(object_from_unit);
}
inline double unit_reach_m(UnitKind kind, const math::Transform& object_from_unit, math::Point3 from_m) {
  return kind->reach_m(object_from_unit, from_m);
}

/// An upper bound, exact for a similarity, of the factor by which a map stretches lengths.
double largest_stretch(const math::Transform& map);

}  // namespace ifov::geometry
