#include "transport/polarized/lobe_mueller.h"

#include "materials/bsdf/node_bsdf.h"
#include "scene/scene.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

void lobe_mueller(const SpectralScene& scene, const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                  const materials::BsdfEvent& event, const materials::MuellerRows& rows, float* work) {
  const materials::SpectralMaterials& materials = scene.materials();
  if (surface.count == 1) {
    materials.directional(surface.constituents[0].material)->evaluate_mueller(event, rows);
    return;
  }
  const std::size_t size = 4 * rows.columns() * rows.stride;
  bool any = false;
  for (const scene::Constituent& part : surface) {
    if (scene.scene().materials[part.material].bsdf.get() != lobe.bsdf) continue;
    const float weight = static_cast<float>(part.weight / lobe.probability);
    materials.directional(part.material)->evaluate_mueller(event, {work, rows.stride, rows.all});
    for (std::size_t k = 0; k < size; ++k)
      rows.values[k] = any ? rows.values[k] + weight * work[k] : weight * work[k];
    any = true;
  }
}

}  // namespace ifov::transport
