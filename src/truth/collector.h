#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "geometry/world.h"
#include "math/ray.h"
#include "scene/scene.h"

namespace ifov::truth {

/// Rays through the middles of pixels, and what each meets first.
struct MiddleRays {
  const scene::Scene& scene;
  std::span<const math::Ray> rays;               ///< from the sensor, scene frame
  std::span<const geometry::SurfacePoint> hits;  ///< one a ray; hit() or not
};

/// What is noted of each pixel beside its radiance while the scene is there: a layer of the tile.
struct Collector {
  template <class Value>
  using Collect = void (*)(const MiddleRays& rays, std::span<Value> values);

  std::string_view name;
  int bands = 1;
  /// Fills [ray * bands + band]; not numbers where there is nothing to say.
  std::variant<Collect<float>, Collect<double>> collect;
};

}  // namespace ifov::truth
