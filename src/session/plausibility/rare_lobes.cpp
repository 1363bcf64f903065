#include "core/format.h"
#include "io/document/document_error.h"
#include "io/document/scene_document.h"
#include "materials/bsdf/narrow_lobes.h"
#include "materials/material.h"
#include "scene/scene.h"
#include "session/plausibility/plausibility.h"
#include "transport/emitters.h"
#include "transport/spectral_scene.h"

namespace ifov::session {

void refuse_rare_lobes(const io::DocumentSources& sources, const io::SceneDocument& written,
                       const transport::SpectralScene& scene) {
  const transport::Emitters* emitters = scene.emitters();
  if (emitters == nullptr || (emitters->count() == 0 && !emitters->leaves_some())) return;
  for (const materials::Material& material : scene.scene().materials) {
    if (!materials::throws_rarely(*material.bsdf)) continue;
    SourcePosition position;
    for (const io::MaterialDocument& own : written.materials)
      if (own.name == material.name) position = own.position;
    throw io::document_error(
        sources, position,
        format(
            "material '{}' has a lobe of roughness {:g}; where lamps or hot things outshine the scene it has to be {:g} or more: "
            "what a narrower one throws of their light is found so seldom that pixels would not know it",
            material.name, material.bsdf->lobe_slopes().least, materials::kLeastFoundSlope));
  }
}

}  // namespace ifov::session
