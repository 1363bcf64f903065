#include "session/one_material.h"

#include <algorithm>
#include <vector>

#include "core/names.h"
#include "io/document/document.h"
#include "scene/scene.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/assignment_assembly.h"
#include "transport/sky/material_ground.h"

namespace ifov::session {

const io::MaterialDocument& find_material(const io::Document& document, const std::string& name) {
  std::vector<std::string> names;
  for (const io::MaterialDocument& material : document.scene.materials) {
    if (material.name == name) return material;
    names.push_back(material.name);
  }
  const std::string choices = list_names(names, "and"), hint = did_you_mean(name, names);
  if (name.empty())
    throw InputError(format("which material of {}? There are {}", document.sources.file_name, choices));
  throw InputError(format("{}: there is no material '{}'{} {}", document.sources.file_name, name,
                          hint.empty() ? "; there are" : hint + " There are", choices));
}

std::optional<materials::Material> surroundings_material(const io::Document& document) {
  const auto& surroundings = document.light.surroundings;
  if (!surroundings || !surroundings->material) return std::nullopt;
  const auto& [name, position] = *surroundings->material;
  const auto& written = document.scene.materials;
  const auto source =
      std::find_if(written.begin(), written.end(), [&](const auto& one) { return one.name == name; });
  if (source == written.end()) {
    std::vector<std::string> names;
    for (const io::MaterialDocument& one : written) names.push_back(one.name);
    const std::string hint = did_you_mean(name, names);
    throw io::document_error(document.sources, position,
                             format("there is no material '{}' for the surroundings{} {}", name,
                                    hint.empty() ? "; there are" : hint + " There are",
                                    names.empty() ? "none" : list_names(names, "and", 12)));
  }
  if (source->sides)
    throw io::document_error(document.sources, position,
                             format("'{}' has two sides: the surroundings are made of '{}' or '{}'", name,
                                    source->sides->first.name, source->sides->second.name));
  materials::Material material = assemble_material(document, *source, 1);
  with_position(document.sources, position, [&] { transport::check_ground(material); });
  return material;
}

materials::Material assemble_material(const io::Document& document, const io::MaterialDocument& source,
                                      int curve) {
  const auto count = static_cast<int>(source.further_curves.size()) + 1;
  if (curve < 1 || curve > count)
    throw io::document_error(document.sources, source.position,
                             format("'{}' has no curve {}; it has {}", source.name, curve,
                                    count == 1 ? std::string("one") : format("1 to {}", count)));
  const std::vector<io::MaterialDocument> alone{source};
  scene::Scene scene;
  const MapFrame frame(document.sources, {});
  const AssignmentAssembly assembly(document.sources, alone, document.seed, frame, scene, nullptr);
  return scene.materials.at(static_cast<std::size_t>(curve - 1));
}

}  // namespace ifov::session
