#pragma once

#include <cstdint>

#include "geometry/unit_shape.h"
#include "math/transform.h"

namespace ifov::geometry {

/// The analytic shapes by name, each in the frame where it is simplest (`units`, a file for each family).
class UnitKind {
 public:
  constexpr UnitKind(const UnitShape& shape) : shape_(&shape) {}
  constexpr const UnitShape* operator->() const { return shape_; }
  friend constexpr bool operator==(UnitKind, UnitKind) = default;

  static const UnitKind box;            ///< [-1, 1] cubed, solid; faces 0 to 5 for -x, +x, -y, +y, -z, +z
  static const UnitKind sphere;         ///< radius 1 about the origin
  static const UnitKind hemisphere;     ///< the half of that sphere with z >= 0
  static const UnitKind open_cylinder;  ///< x^2 + y^2 = 1, 0 <= z <= 1, open at both ends
  static const UnitKind cylinder;       ///< the same with its ends; faces: 0 side, 1 lower end, 2 upper end
  static const UnitKind disk;           ///< z = 0, x^2 + y^2 <= 1, outside is +z

 private:
  const UnitShape* shape_;
};

namespace units {
extern const UnitShape kBox, kSphere, kHemisphere, kOpenCylinder, kCylinder, kDisk;
}

inline constexpr UnitKind UnitKind::box{units::kBox};
inline constexpr UnitKind UnitKind::sphere{units::kSphere};
inline constexpr UnitKind UnitKind::hemisphere{units::kHemisphere};
inline constexpr UnitKind UnitKind::open_cylinder{units::kOpenCylinder};
inline constexpr UnitKind UnitKind::cylinder{units::kCylinder};
inline constexpr UnitKind UnitKind::disk{units::kDisk};

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
