#pragma once

#include <cstdint>

#include "math/vec3.h"

namespace ifov::geometry {

inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;

/// How the reflecting normal changes about a surface point.
enum class Bend : std::uint8_t {
  none,    ///< a plane, a flat face
  facet,   ///< a triangle without vertex normals
  round,   ///< a round analytic shape
  smooth,  ///< a triangle with vertex normals, which may all be alike
  field    ///< a height field
};

/// What a ray met, recomputed in double from the primitive. `material == kNoMaterial` means that it met
/// nothing.
struct SurfacePoint {
  math::Point3 position_m;
  math::Normal3 geometric_normal;  ///< unit, towards the outside of the surface (not towards the viewer)
  math::Normal3 shading_normal;  ///< unit, same side as the geometric one; equal to it without vertex normals
  double distance_m = 0.0;
  double u = 0.0, v = 0.0;     ///< texture coordinates, [0, 1] on primitives, as in the file on meshes
  std::uint32_t instance = 0;  ///< number of the placed object, unique in the scene
  std::uint32_t patch = 0;     ///< smooth patch of the object: facets connected without a crease
  std::uint32_t material = kNoMaterial;  ///< index into the scene's materials
  std::uint32_t primitive = 0;
  bool front = true;  ///< the ray met the outer side
  /// An object placed earlier whose surface lies in the same place, but for rounding; kNoMaterial: there is none.
  std::uint32_t shared_with = kNoMaterial;
  Bend bend = Bend::none;
  double offset_m = 0.0;  ///< a secondary ray starts this far along the normal, on the side it leaves to
  std::int32_t copy_column = 0, copy_row = 0;  ///< of a periodic world: periods from the object's own place
  bool hit() const { return material != kNoMaterial; }
};

}  // namespace ifov::geometry
