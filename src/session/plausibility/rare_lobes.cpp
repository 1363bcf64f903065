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
  const bool sought = emitters != nullptr && emitters->outshine(), sunlit = scene.scene().sun.has_value();
  const auto refuse = [&](const materials::Material& material, const std::string& why) {
    SourcePosition position;
    for (const io::MaterialDocument& own : written.materials)
      if (own.name == material.name) position = own.position;
    throw io::document_error(sources, position, format("material '{}' {}", material.name, why));
  };
  for (const materials::Material& material : scene.scene().materials) {
    const materials::Bsdf& bsdf = *material.bsdf;
    if (sought && bsdf.passed_spread() > 0.0)
      refuse(
          material,
          "refracts at a rough boundary, through which lamps and things that outshine the scene are not sought: take "
          "'smooth', or leave them out");
    if (sunlit && materials::passes_rarely(bsdf))
      refuse(
          material,
          format(
              "has a roughness of {:g}; under a Sun it has to be {:.2g} or more at its index of {:g}: sunlight that a "
              "smoother boundary lets through is found so seldom that pixels would not know it",
              bsdf.lobe_slopes().least, 2.0 * materials::kLeastFoundSlope / (bsdf.bending_index() - 1.0),
              bsdf.bending_index()));
  }
}

}  // namespace ifov::session
