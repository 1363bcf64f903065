#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <vector>

#include "geometry/world.h"
#include "geometry/world/ray_packet.h"
#include "math/transform.h"

namespace ifov::geometry {

/// Instances in a table of our own, one Embree geometry for all of them: a tree over their boxes leads to rays that are
/// turned into the frame of the body and traced there. Takes about a third of the memory of Embree's instances.
struct InstanceSet {
  /// A body that instances refer to, by template.
  struct Target {
    RTCScene scene = nullptr;
    World::Bounds bounds{};  ///< in the frame of its set
  };

  const std::vector<math::Transform>* set_from_scene = nullptr;  ///< by instance
  const std::vector<Piece>* pieces = nullptr;                    ///< by instance
  std::vector<Target> targets;
  double padding_m = 0.0;  ///< by which boxes are widened against Embree's rounding
};

/// Bounds of a box's image.
World::Bounds image_of(const World::Bounds& box, const math::Transform& map);

/// The set must outlive the scene.
void attach_instance_set(RTCDevice device, RTCScene scene, unsigned geometry, const InstanceSet& set);

}  // namespace ifov::geometry
