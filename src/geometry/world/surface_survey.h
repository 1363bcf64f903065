#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh_lists.h"
#include "geometry/unit_kind.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// Where the surfaces of some materials are and how they bend, in the scene frame: for those who look for light that
/// comes by way of them. A surface of those materials that is in none of the lists does not exist.
struct SurfaceSurvey {
  /// Normals closer to each other than this, or to each other's opposite, count as one: 1/200 of the Sun's half-angle.
  static constexpr double kSameNormal_rad = 2e-5;
  /// So many different normals are kept; faces with further ones are listed by their balls.
  static constexpr std::size_t kMostFlats = 65536;

  /// All faces of one normal; those whose vertex normals are all alike are faces with that normal.
  struct Flat {
    math::Vec3 normal;       ///< unit, of the first face found; the other side counts as this one
    World::Bounds bounds{};  ///< of all of them
    double area_m2 = 0.0;
    double low_m = 0.0, high_m = 0.0;  ///< range of normal . p over them
    /// normal . p of the planes that they lie in, where those are at most kMostPlanes; else empty.
    std::vector<double> planes_m;
    bool many_planes = false;
  };
  static constexpr std::size_t kMostPlanes = 8;
  /// Planes nearer to each other than this are one.
  static constexpr double kSamePlane_m = 1e-5;
  /// A sphere about things.
  struct Ball {
    math::Point3 centre_m;
    double radius_m = 0.0;
  };
  /// A round analytic shape that is known as a mirror; those with flat faces too have them among the flats.
  struct Round {
    UnitKind kind = UnitKind::sphere;
    math::Transform scene_from_unit;
    std::uint32_t object = 0;
    Ball ball;  ///< about it
  };
  /// A mesh with vertex normals, some of whose triangles bend: `triangles`. Of all triangles, where facets were asked for.
  struct Smooth {
    MeshLists mesh;
    math::Transform scene_from_mesh;
    std::uint32_t object = 0;
    std::vector<std::uint32_t> triangles;
    Ball ball;  ///< about them
  };
  /// So many triangles are listed where facets are asked for; else none is.
  static constexpr std::size_t kMostFacets = std::size_t{1} << 22;
  std::vector<Flat> flats;
  std::vector<Round> rounds;
  std::vector<Smooth> smooths;
  /// About what is neither flat nor known as a mirror: other round shapes, smooth triangles, height fields, flats too many.
  std::vector<Ball> balls;
  /// Where facets were asked for, the flat faces of shapes, and planes: no other list has them.
  struct Face {
    math::Vec3 normal;  ///< unit
    Ball ball;          ///< about it
    double area_m2 = 0.0;
  };
  std::vector<Face> faces;
  bool all_flats = true;   ///< false: there are more than kMostFlats normals
  bool all_facets = true;  ///< false: there are more than kMostFacets
};

}  // namespace ifov::geometry
