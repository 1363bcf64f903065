#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "geometry/world.h"
#include "math/ray.h"
#include "scene/scene.h"

namespace ifov::sampling {
struct FocalPoint;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::truth {

/// Rays through the middles of pixels that stand side by side in a line of the image, and what each meets first.
struct MiddleRays {
  const scene::Scene& scene;
  std::span<const math::Ray> rays;                        ///< from the sensor, scene frame
  std::span<const geometry::SurfacePoint> hits;           ///< one a ray; hit() or not
  std::span<const scene::ResolvedSurface> surfaces = {};  ///< of the hits, without solved temperatures
  std::span<const sampling::FocalPoint> points = {};      ///< where the rays go through the focal plane
  const sensor::Camera* camera = nullptr;                 ///< that sent them
  std::span<const std::uint32_t> truth_materials = {};    ///< scene::TruthMaterials::of_material
};

/// What is noted of each pixel beside its radiance while the scene is there: a layer of the tile.
struct Collector {
  template <class Value>
  using Collect = void (*)(const MiddleRays& rays, std::span<Value> values);

  std::string_view name;
  int bands = 1;
  /// Fills [ray * bands + band]; not numbers, or 0 of whole ones, where there is nothing to say.
  std::variant<Collect<float>, Collect<double>, Collect<std::uint16_t>, Collect<std::uint32_t>> collect;
};

}  // namespace ifov::truth
