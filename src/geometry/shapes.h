#pragma once

#include <variant>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "math/transform.h"
#include "math/vec3.h"

namespace ifov::geometry {

// Shapes in their object's frame, metres. A transform (rotation, scale, also unequal) places them in the
// scene.

/// The horizontal plane z = z_m, without end; outside is up. Texture coordinates are x and y in metres.
struct Plane {
  double z_m = 0.0;
};

/// Solid; a patch for each face: 0 to 5 for -x, +x, -y, +y, -z, +z.
struct Box {
  math::Point3 low_m, high_m;
};

/// Solid. u is the azimuth from +x as a fraction of a turn, v rises from 0 at the bottom to 1 at the top.
struct Sphere {
  math::Point3 centre_m;
  double radius_m = 1.0;
};

/// The upper half (z above the centre) of a sphere's surface, without a floor.
struct Hemisphere {
  math::Point3 centre_m;
  double radius_m = 1.0;
};

/// About a vertical axis that rises from the centre of the base. Patches: 0 side, 1 lower cap, 2 upper cap.
struct Cylinder {
  math::Point3 base_m;
  double radius_m = 1.0;
  double height_m = 1.0;
  bool capped = true;
};

/// Horizontal; outside is up.
struct Disk {
  math::Point3 centre_m;
  double radius_m = 1.0;
};

/// A simple planar polygon, convex or not, counter-clockwise when seen from outside.
struct Polygon {
  std::vector<math::Point3> vertices_m;
};

struct UnitShape;

/// Any analytic shape, of a size and at a place that the map gives; `unit` lives as long as the scene.
struct PlacedUnit {
  const UnitShape* unit = nullptr;
  math::Transform object_from_unit;
  /// A point in a solid, or one such that rays towards it from most sides meet the surface.
  math::Point3 pilot_in_unit;
  bool solid = false;
};

using Shape = std::variant<Plane, Box, Sphere, Hemisphere, Cylinder, Disk, Polygon, PlacedUnit, TriangleMesh>;

}  // namespace ifov::geometry
