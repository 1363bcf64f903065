#pragma once

#include <cstdint>
#include <limits>

#include "geometry/triangle_mesh.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// The analytic shapes, each in the frame where it is simplest.
enum class UnitKind : std::uint8_t {
  box,            ///< [-1, 1] cubed, solid; faces 0 to 5 for -x, +x, -y, +y, -z, +z
  sphere,         ///< radius 1 about the origin
  hemisphere,     ///< the half of that sphere with z >= 0
  open_cylinder,  ///< x^2 + y^2 = 1, 0 <= z <= 1, open at both ends
  cylinder,       ///< the same with its ends; faces: 0 side, 1 lower end, 2 upper end
  disk            ///< z = 0, x^2 + y^2 <= 1, outside is +z
};

/// An analytic shape as it lies in an object: the affine map carries position, size and unequal scale.
struct UnitPrimitive {
  math::Transform unit_from_object;
  std::uint32_t patch = 0;  ///< of face 0 within the object; other faces follow
  std::uint32_t slot = 0;
  UnitKind kind = UnitKind::sphere;
};

/// Where a line p + t d meets a unit shape: the smallest t strictly between the limits, and the face met
/// there.
struct UnitHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t face = 0;
};
UnitHit intersect_unit(UnitKind kind, math::Point3 p, math::Vec3 d, double t_min, double t_max);

/// Outward normal (length 1) and texture coordinates at a point of the surface.
math::Normal3 unit_normal(UnitKind kind, std::uint32_t face, math::Point3 p);
Uv unit_uv(UnitKind kind, std::uint32_t face, math::Point3 p);

std::uint32_t unit_face_count(UnitKind kind);
constexpr bool is_round(UnitKind kind, std::uint32_t face) {
  return kind == UnitKind::sphere || kind == UnitKind::hemisphere || kind == UnitKind::open_cylinder ||
         (kind == UnitKind::cylinder && face == 0);
}

/// Axis-aligned bounds of the shape seen from the object, and a bound on its distance from a point.
World::Bounds unit_bounds(UnitKind kind, const math::Transform& object_from_unit);
double unit_reach_m(UnitKind kind, const math::Transform& object_from_unit, math::Point3 from_m);

/// An upper bound, exact for a similarity, of the factor by which a map stretches lengths.
double largest_stretch(const math::Transform& map);

}  // namespace ifov::geometry
