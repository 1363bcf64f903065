#include "truth/identity.h"

#include <algorithm>

namespace ifov::truth {
namespace {

void collect_materials(const MiddleRays& rays, std::span<std::uint16_t> values) {
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    values[k] = 0;
    if (!rays.hits[k].hit()) continue;
    const scene::ResolvedSurface& surface = rays.surfaces[k];
    const scene::Constituent* const most = std::max_element(
        surface.begin(), surface.end(),
        [](const scene::Constituent& a, const scene::Constituent& b) { return a.weight < b.weight; });
    values[k] = static_cast<std::uint16_t>(rays.truth_materials[most->material] + 1);
  }
}

void collect_instances(const MiddleRays& rays, std::span<std::uint32_t> values) {
  for (std::size_t k = 0; k < rays.hits.size(); ++k)
    values[k] = rays.hits[k].hit() ? rays.hits[k].instance + 1 : 0;
}

}  // namespace

constinit const Collector kMaterial{"material", 1, collect_materials};
constinit const Collector kInstance{"instance", 1, collect_instances};

}  // namespace ifov::truth
