#pragma once

#include "landscape/shapes/mesh_builder.h"

/// Parts of houses and other buildings, added to a mesh.
namespace ifov::landscape {

/// The direction, level, that a wall looks to.
struct Facing {
  Vec3 outward;
};

/// A window on a wall: `sill` is the middle of its lower edge. Slots: trim, window.
void window(MeshBuilder& mesh, Point3 sill_m, Facing facing, double width_m, double height_m);
/// Both on a wall that looks to -y; `threshold` is the middle of the lower edge. Slots: door, garage door, trim,
/// concrete (the step).
void front_door(MeshBuilder& mesh, Point3 threshold_m);
void garage_door(MeshBuilder& mesh, Point3 threshold_m, double width_m, double height_m);
/// A stack with two flues from inside the roof up to `top_m`. Slots: brick, concrete.
void chimney(MeshBuilder& mesh, Point3 base_m, double top_m);

}  // namespace ifov::landscape
