#pragma once

#include "geometry/triangle_mesh.h"
#include "landscape/shapes/plane.h"
#include "landscape/shapes/random_stream.h"

namespace ifov::landscape {

enum class RoofKind { gabled, hipped };

/// A house in its own axes: x along the street, y away from it, the front wall of its main part at y = 0, ground
/// at z = 0. Lengths in metres.
struct HousePlan {
  RoofKind roof = RoofKind::gabled;
  double width = 13.0, depth = 9.0;  ///< of the main part, walls
  double wall_height = 2.7;
  double slope = 0.5;  ///< rise over run of the roof
  double eaves = 0.5;  ///< overhang

  /// The garage, which stands forward of the front wall at its left (-1) or right (+1) end.
  int garage_side = 1;
  double garage_width = 6.0, garage_depth = 4.0;
  static constexpr double garage_wall_height = 2.6;

  double door_x = -1.0;     ///< middle of the front door
  double chimney_x = -3.0;  ///< middle of the chimney, on the rear slope
  bool chimney = true;

  double garage_middle() const { return garage_side * 0.5 * (width - garage_width); }
  double ridge_height() const { return wall_height + slope * 0.5 * depth; }
  /// With its eaves.
  Footprint footprint(const Stand& stand) const;
};

/// One of the designs that suburbs are built from: sizes, pitch and details by chance.
HousePlan draw_house(const RandomStream& random);

/// Slots: roof, wall, trim, window, door, garage door, brick, concrete.
geometry::TriangleMesh house_mesh(const HousePlan& plan);

}  // namespace ifov::landscape
