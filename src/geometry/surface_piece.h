#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "math/transform.h"

namespace ifov::geometry {

/// The shapes that surfaces are made of. `scene_from_unit` of a piece carries the unit shape into the scene.
enum class PieceKind : std::uint8_t {
  triangle,       ///< corners at the origin, x = 1 and y = 1
  parallelogram,  ///< the unit square in x and y from the origin
  disk,           ///< x^2 + y^2 <= 1, z = 0
  open_cylinder,  ///< x^2 + y^2 = 1, 0 <= z <= 1, open
  ball,           ///< radius 1 about the origin
  hemisphere      ///< the half of that sphere with z >= 0
};

/// A part of the surface of a placed object, small enough to send rays at. A ray that meets it gets a SurfacePoint with
/// its object (as `instance`), primitive and patch; no other piece has all three.
struct SurfacePiece {
  math::Transform scene_from_unit;
  std::uint32_t object = 0, primitive = 0, patch = 0;
  std::uint32_t material = 0;  ///< index into the scene's surface assignments, as in SurfacePoint
  PieceKind kind = PieceKind::triangle;
  bool solid = false;  ///< a flat face of a solid, whose outside is where x cross y of the map points
};

/// Area of a piece, m^2: exact where the map is a similarity; of other balls, hemispheres and open cylinders by the mean of its
/// stretches.
double area_m2(const SurfacePiece& piece);

/// By SurfacePoint::material: whether it is asked for.
using WantedMaterials = std::vector<bool>;
using PieceVisitor = std::function<void(const SurfacePiece&)>;

}  // namespace ifov::geometry
