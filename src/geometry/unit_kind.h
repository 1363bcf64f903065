#pragma once

namespace ifov::geometry {

struct UnitShape;

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

}  // namespace ifov::geometry
