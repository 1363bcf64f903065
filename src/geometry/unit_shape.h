#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "geometry/surface_piece.h"
#include "geometry/triangle_mesh.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// Where a line p + t d meets a unit shape: the smallest t strictly between the limits, and the face met
/// there.
struct UnitHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t face = 0;
};

/// A flat face as a parallelogram, or the rectangle about a disk: outward normal, middle, half its sides.
using UnitFlatVisitor =
    std::function<void(math::Vec3 normal, math::Point3 middle, math::Vec3 first, math::Vec3 second)>;
/// A face as a piece that rays are sent at.
using UnitPieceVisitor = std::function<void(PieceKind kind, std::uint32_t face,
                                            const math::Transform& scene_from_face, bool solid)>;

/// What an analytic shape is, in the frame where it is simplest.
struct UnitShape {
  std::uint32_t faces = 1;
  std::uint32_t round_faces = 0;  ///< a bit for each face that is curved

  UnitHit (*intersect)(math::Point3 p, math::Vec3 d, double t_min, double t_max) = nullptr;
  /// Outward normal (length 1) and texture coordinates at a point of the surface.
  math::Normal3 (*normal)(std::uint32_t face, math::Point3 p) = nullptr;
  Uv (*uv)(std::uint32_t face, math::Point3 p) = nullptr;

  /// Axis-aligned bounds of the shape seen from the object, and a bound on its distance from a point.
  World::Bounds (*bounds)(const math::Transform& object_from_unit) = nullptr;
  double (*reach_m)(const math::Transform& object_from_unit, math::Point3 from_m) = nullptr;

  /// Its flat faces, in its own frame; null: none. For mirrors.
  void (*visit_flats)(const UnitFlatVisitor& visitor) = nullptr;
  /// All faces; null: rays are not sent at it where it shines, but find it by chance.
  void (*visit_pieces)(const math::Transform& scene_from_unit, const UnitPieceVisitor& visitor) = nullptr;

  bool centred = false;  ///< the sphere about it is about the origin, not about the middle of its bounds
  bool known_as_mirror = false;  ///< transport::RoundMirror knows the images in its round face
};

}  // namespace ifov::geometry
