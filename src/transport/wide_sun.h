#pragma once

#include "scene/scene.h"

namespace ifov::transport {

/// A Sun of the same irradiance as wide as a third of the sky, which paths find by chance: tells how much light may
/// come by ways that are not sought.
struct WideSun {
  /// All directions at an angle with this cosine or less from its middle, pi steradians.
  static constexpr double kLeastCosine = 0.5;
  /// Its radiance in a direction over the Sun's irradiance, 1/sr.
  static float radiance(const scene::Scene& scene, math::Vec3 direction) {
    return direction.z > 0.0 && math::dot(direction, scene.sun->direction) > kLeastCosine ? 0.31830989f
                                                                                          : 0.0f;
  }
};

}  // namespace ifov::transport
