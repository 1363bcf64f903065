#include "transport/polarized/lobe_mueller.h"

#include <algorithm>

#include "materials/bsdf/node_bsdf.h"
#include "scene/scene.h"
#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"

namespace ifov::transport {
namespace {

/// Of one material; a separable delta has its reflectance besides.
void evaluate(const SpectralScene& scene, std::uint32_t material, const materials::BsdfEvent& event,
              const materials::MuellerRows& rows) {
  const materials::SpectralMaterials& materials = scene.materials();
  if (const materials::NodeBsdf* model = materials.directional(material))
    return model->evaluate_mueller(event, rows);
  scene.scene().materials[material].bsdf->evaluate_mueller(event, {}, rows.stride, rows);
  const float* factor = event.side == materials::Side::transmitted ? materials.transmittance(material)
                                                                   : materials.reflectance(material);
  for (std::size_t k = 0; k < 4 * rows.columns(); ++k)
    spectra::scale(rows.values + k * rows.stride, factor, rows.stride);
}

}  // namespace

void lobe_mueller(const SpectralScene& scene, const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                  const materials::BsdfEvent& event, const materials::MuellerRows& rows, float* work) {
  if (surface.count == 1) return evaluate(scene, surface.constituents[0].material, event, rows);
  const std::size_t size = 4 * rows.columns() * rows.stride;
  bool any = false;
  for (const scene::Constituent& part : surface) {
    if (!belongs(scene, lobe, part)) continue;
    const float weight = static_cast<float>(part.weight / lobe.probability);
    evaluate(scene, part.material, event, {work, rows.stride, rows.all});
    for (std::size_t k = 0; k < size; ++k)
      rows.values[k] = any ? rows.values[k] + weight * work[k] : weight * work[k];
    any = true;
  }
  if (!any) std::fill_n(rows.values, size, 0.0f);
}

}  // namespace ifov::transport
