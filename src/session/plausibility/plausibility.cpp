#include "session/plausibility/plausibility.h"

#include <algorithm>
#include <vector>

#include "core/format.h"
#include "geometry/world/surface_survey.h"
#include "materials/bsdf/narrow_lobes.h"
#include "materials/material.h"
#include "scene/scene.h"
#include "session/loaded/parts.h"
#include "session/plausibility/light_warnings.h"
#include "session/plausibility/location_lines.h"
#include "session/plausibility/motion_lines.h"
#include "session/plausibility/plausibility_warnings.h"
#include "transport/emitters.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/spectral_scene.h"

namespace ifov::session {

void tell_of_emitters(const transport::SpectralScene& scene, LogSink& log) {
  const transport::Emitters* emitters = scene.emitters();
  if (emitters == nullptr) return;
  if (emitters->count() > 0)
    log.info(format("emitters: lamps, and faces brighter than the scene, whose light is sought: {}",
                    emitters->count()));
  if (emitters->declines_some())
    log.warn(
        "light of materials with \"emitter\": false that outshine the scene is found by random paths alone: pixels are marked "
        "that they may light");
  if (emitters->passes_over())
    log.warn(format(
        "light of some surfaces that outshine the scene is found by random paths alone: it is not sought from planes and "
        "terrain, nor from more than {} faces; of those beyond that number, pixels are marked that they may light",
        transport::Emitters::kMost));
  if (emitters->outshine() && transport::EmitterMirrors::leave_some(scene.scene()))
    log.warn(
        "light of surfaces that outshine the scene is sought by way of one mirror that is flat, a ball or a round "
        "column, not of other shapes or of several in turn: what those throw of it on other surfaces is found by chance "
        "alone; pixels are marked that it may reach");
  const std::vector<materials::Material>& materials = scene.scene().materials;
  const auto rare = std::find_if(materials.begin(), materials.end(), [](const materials::Material& material) {
    return materials::throws_rarely(*material.bsdf);
  });
  if (emitters->outshine() && rare != materials.end())
    log.warn(format(
        "material '{}' has a lobe of roughness {:g}: what lobes narrower than {:g} throw on other surfaces of the light "
        "of what outshines the scene, and small highlights of it, are found by chance alone; pixels are marked "
        "that it may reach",
        rare->name, rare->bsdf->lobe_slopes().least, materials::kLeastFoundSlope));
  if (emitters->outshine() && scene.materials().any_medium())
    log.warn(
        "light of surfaces that outshine the scene is sought through panes, not through boundaries that refract it: what "
        "comes by way of such media is found by chance alone; pixels are marked that it may reach");
}

void tell_of_highlights(const transport::SpectralScene& scene, LogSink& log) {
  const transport::SunLobes* lobes = scene.sun_lobes();
  if (lobes != nullptr && !lobes->survey().all_facets)
    log.warn(format(
        "meshes with glossy materials have more than {} triangles: the Sun's highlights on them are found by random "
        "paths alone, and pixels whose highlights are smaller than they may be less sure than they say",
        geometry::SurfaceSurvey::kMostFacets));
}

void check_plausibility(Parts& parts, LogSink& log) {
  const SceneSurvey survey = survey_scene(parts);
  parts.locations = location_lines(parts, survey);
  for (const std::string& line : parts.locations) log.info(line);
  require_light(parts, survey);
  warn_of_locations(parts, survey, log);
  warn_of_standing(parts, log);
  warn_of_motion(parts, log);
  warn_of_moving_light(parts, log);
  warn_of_values(parts, survey, log);
  warn_of_colours(parts, log);
}

}  // namespace ifov::session
