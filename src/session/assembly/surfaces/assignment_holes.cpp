// Where surfaces have holes, and what must not have any.

#include "core/overloaded.h"
#include "io/document/file_materials_document.h"
#include "io/document/opacity_document.h"
#include "scene/cut_out.h"
#include "scene/scene.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/assignment_assembly.h"

namespace ifov::session {
namespace {

/// Every material of the document that a binding names.
template <class Visitor>
void visit_names(const io::MaterialBinding& binding, const Visitor& visitor) {
  std::visit(Overloaded{[&](const io::DocumentName& name) { visitor(name); },
                        [&](const io::MaterialSlots& slots) {
                          for (const auto& slot : slots.slots) visitor(slot.second);
                        },
                        [&](const io::MaterialMap& map) {
                          for (const auto& entry : map.classes) visitor(entry.second);
                        },
                        [&](const io::MixtureDocument& mixture) {
                          for (const io::DocumentName& name : mixture.materials) visitor(name);
                        },
                        [&](const std::shared_ptr<const io::FileMaterials>& file) {
                          for (const io::FileMaterials::Colour& colour : file->colours)
                            visitor(colour.material);
                          for (const auto& slot : file->slots) visitor(slot.second);
                        }},
             binding.value);
}

}  // namespace

void AssignmentAssembly::refuse_media(const io::MaterialBinding& binding) const {
  visit_names(binding, [&](const io::DocumentName& name) {
    if (refracts(material_index(name.name)))
      throw io::document_error(
          sources_, binding.position,
          format(
              "light is refracted into '{}', but this shape has no inside: take a solid (a box, a sphere, a "
              "closed mesh) or a plane, {{\"slab\": ...}} for a pane, or \"over\": \"absorber\" where "
              "what enters it ends there",
              name.name));
  });
}

void AssignmentAssembly::refuse_holes(const io::MaterialBinding& binding, bool by_place) const {
  visit_names(binding, [&](const io::DocumentName& name) {
    std::vector<std::string> sides{name.name};
    if (const auto& both = written_[material_index(name.name)].sides)
      sides = {both->first.name, both->second.name};
    for (const std::string& side : sides) {
      const std::shared_ptr<const io::OpacityDocument>& opacity = written_[material_index(side)].opacity;
      if (!opacity || (by_place && !opacity->raster.by_texture)) continue;
      throw io::document_error(
          sources_, binding.position,
          by_place
              ? format(
                    "'{}' has an 'opacity' map by texture coordinates, of which this shape has none: take a mesh "
                    "with them, or a map by place",
                    side)
              : format(
                    "'{}' has an 'opacity' map, and this shape cannot have holes: take a polygon, a mesh, or "
                    "a terrain in the form of a mesh",
                    side));
    }
  });
}

void AssignmentAssembly::add_holes(scene::SurfaceAssignment& assignment, const io::MaterialBinding& binding,
                                   const std::vector<Surface>& surfaces, const Holes& of_file) {
  std::vector<Holes> holes;
  for (const Surface& surface : surfaces) {
    if (surface.holes && of_file)
      throw InputError(format(
          "'{}' has an 'opacity' map, and the mesh file says itself where it has holes: one of them is enough",
          scene_.materials[surface.material].name));
    holes.push_back(of_file ? of_file : surface.holes);
    if (!holes.back()) continue;
    if (std::holds_alternative<io::MixtureDocument>(binding.value))
      throw InputError(format("a mixture cannot hold '{}', which has an 'opacity' map; a map of classes can",
                              scene_.materials[surface.material].name));
    if (refracts(surface.material))
      throw InputError(
          format("light is refracted into '{}', which cannot have an 'opacity' map: a solid has no holes",
                 scene_.materials[surface.material].name));
  }
  assignment.cut_out = cut_out(assignment.classes, holes);
}

std::shared_ptr<const scene::SurfaceCutOut> AssignmentAssembly::cut_out(
    const std::shared_ptr<const materials::ClassMap>& classes, const std::vector<Holes>& holes) {
  std::string key = format("{}", static_cast<const void*>(classes.get()));
  bool any = false;
  for (const auto& one : holes) {
    key += format("|{}", static_cast<const void*>(one.get()));
    any = any || one != nullptr;
  }
  if (!any) return nullptr;
  std::shared_ptr<const scene::SurfaceCutOut>& shared = cut_outs_[key];
  if (!shared) shared = std::make_shared<const scene::SurfaceCutOut>(classes, holes);
  return shared;
}

std::vector<std::shared_ptr<const geometry::CutOut>> AssignmentAssembly::cut_outs() const {
  return scene::cut_outs(scene_);
}

}  // namespace ifov::session
