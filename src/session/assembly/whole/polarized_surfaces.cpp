#include "session/assembly/whole/polarized_surfaces.h"

#include <algorithm>

#include "core/format.h"
#include "io/document/document_error.h"
#include "io/document/scene_document.h"
#include "materials/bsdf/bsdf.h"
#include "materials/material.h"
#include "scene/scene.h"

namespace ifov::session {

void check_polarized(const io::DocumentSources& sources, const io::SceneDocument& written,
                     const scene::Scene& scene) {
  for (const io::MaterialDocument& material : written.materials) {
    const auto assembled = std::ranges::find(scene.materials, material.name, &materials::Material::name);
    if (assembled == scene.materials.end() || assembled->bsdf->polarizes()) continue;
    if (!assembled->bsdf->is_delta() && assembled->bsdf->passage() == materials::Passage::none) continue;
    throw io::document_error(
        sources, material.position,
        format("material '{}': how a '{}' surface polarizes light is not worked out; give it another "
               "'scattering', or the sensor neither 'stokes' nor polarizers and retarders",
               material.name, material.scattering.model));
  }
}

}  // namespace ifov::session
