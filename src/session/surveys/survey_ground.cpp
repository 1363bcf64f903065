#include "session/surveys/survey_ground.h"

#include <algorithm>

#include "core/format.h"
#include "core/names.h"
#include "io/document/document.h"
#include "session/one_material.h"
#include "session/surveys/survey_stage.h"
#include "transport/sky/material_ground.h"

namespace ifov::session {
namespace {

materials::Material material_asked(const io::Document& document, const std::string& name,
                                   const SurveyStage& stage) {
  const auto& written = document.scene.materials;
  const bool has_one = std::any_of(written.begin(), written.end(), [&](const io::MaterialDocument& material) {
    return material.name == name;
  });
  if (name == "surroundings" && !has_one) {
    if (!document.light.surroundings)
      throw io::document_error(document.sources, document.light.position,
                               "'surroundings' were asked for as the ground, and 'light' has none");
    return stage.scene.materials[stage.scene.surroundings.material];
  }
  if (!has_one) {
    std::vector<std::string> names;
    for (const io::MaterialDocument& material : written) names.push_back(material.name);
    const std::string hint = did_you_mean(name, names);
    throw InputError(format(
        "the ground '{}' is neither a reflectance nor 'surroundings' nor a material of the document{} {}",
        name, hint.empty() ? "; its materials are" : hint + " Its materials are",
        list_names(names, "and", 12)));
  }
  const io::MaterialDocument& source = find_material(document, name);
  if (source.sides)
    throw io::document_error(document.sources, source.position,
                             format("'{}' has two sides: ask for '{}' or '{}'", name,
                                    source.sides->first.name, source.sides->second.name));
  return assemble_material(document, source, 1);
}

}  // namespace

SurveyGround survey_ground(const io::Document& document, const std::string& name, double reflectance,
                           const SurveyStage& stage) {
  if (name.empty())
    return {
        radiometry::Spectrum::constant(reflectance), nullptr, {}, format("of reflectance {:g}", reflectance)};
  const materials::Material material = material_asked(document, name, stage);
  SurveyGround ground;
  ground.reflectance = material.reflectance;
  ground.directional =
      transport::material_ground(material, stage.scene.sun ? stage.scene.sun->azimuth_rad() : 0.0);
  if (ground.directional) ground.left_out = transport::left_out_of(*ground.directional);
  ground.description = format("'{}'{}", name, ground.directional ? " by its BRDF" : "");
  return ground;
}

}  // namespace ifov::session
