#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// The material of what the ray through the pixel's middle meets, of several that share it the one with the largest share: 1 + its
/// number in scene::TruthMaterials; 0 where the ray meets nothing.
extern const Collector kMaterial;
/// The placed object that the ray meets: 1 + its number in the world (SurfacePoint::instance); 0 where it meets nothing.
extern const Collector kInstance;

}  // namespace ifov::truth
