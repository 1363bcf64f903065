#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/world/world_content.h"

namespace ifov::geometry {

/// What a template holds, all its parts and theirs included. Patches wrap at 32 bits.
struct Contents {
  std::uint64_t triangles = 0, shapes = 0;
  std::uint32_t patches = 0;
};
std::vector<Contents> contents_of(const WorldContent& content);

/// The ray tracer knows one level of instances, so prototypes of prototypes are either flattened (all triangles of a
/// prototype in one body, placed whole) or stand in the scene part by part. Flattening costs memory for every
/// triangle once, standing apart costs memory for every part of every copy: what is smaller is taken, and flattening
/// where it is small anyway, because rays find their way faster in one tree.
struct PrototypePlan {
  std::vector<bool> flat;             ///< by template: has a body of its own; true for shapes
  std::vector<std::uint64_t> copies;  ///< by template with a body: how many stand in the scene
  std::uint64_t apart = 0;            ///< prototypes in use whose parts stand in the scene
};

/// Throws InputError where both ways lead to more parts than can be numbered, SystemError where there is no memory
/// to list them.
PrototypePlan plan_prototypes(const WorldContent& content, const std::vector<Contents>& contents);

/// Gives a body to every flat prototype that stands in the scene.
void flatten(WorldContent& content, const PrototypePlan& plan);

}  // namespace ifov::geometry
