#include "session/one_material.h"

#include "core/names.h"
#include "io/document/document.h"
#include "scene/scene.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/surfaces/assignment_assembly.h"

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
