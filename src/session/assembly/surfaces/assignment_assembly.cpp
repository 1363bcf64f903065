#include "session/assembly/surfaces/assignment_assembly.h"

#include <algorithm>

#include "core/overloaded.h"
#include "io/document/file_materials_document.h"
#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/hemisphere.h"
#include "scene/scene.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

/// What is seen otherwise from behind is smooth and of one kind.
void check_two_sided(const io::MaterialDocument& source) {
  const auto refuse = [&](const char* what) {
    throw InputError(
        format("material '{}': {} cannot be on a '{}' surface that is seen otherwise from its inner side",
               source.name, what, source.scattering.model));
  };
  if (!source.further_curves.empty()) refuse("a texture");
  if (source.relief) refuse("a relief");
  if (ScatteringAssembly::map_count(source) > 0) refuse("a map of a parameter");
}

}  // namespace

AssignmentAssembly::AssignmentAssembly(const io::DocumentSources& sources,
                                       const std::vector<io::MaterialDocument>& materials, std::uint64_t seed,
                                       const MapFrame& frame, scene::Scene& scene, LogSink* log)
    : sources_(sources),
      written_(materials),
      scene_(scene),
      log_(log),
      textures_(sources, materials, seed, frame, log),
      scattering_(sources, textures_, log),
      colours_(sources, scene, log) {
  add_materials();
}

void AssignmentAssembly::add_materials() {
  std::vector<materials::Material> further;
  const auto first = static_cast<std::uint32_t>(written_.size());
  for (const io::MaterialDocument& source : written_) {
    materials::Material material;
    material.name = source.name;
    material.emitter = source.emitter;
    if (source.sides) {
      // Holds the place of the document's material; surfaces are of its sides.
      material.reflectance = radiometry::Spectrum::constant(0.0);
      material.curve_of = material_index(source.sides->first.name);
      first_further_.push_back(first + static_cast<std::uint32_t>(further.size()));
      behind_.push_back(static_cast<std::uint32_t>(scene_.materials.size()));
      scene_.materials.push_back(std::move(material));
      continue;
    }
    if (source.transmittance)
      material.transmittance =
          assemble_spectrum(sources_, *source.transmittance, format("transmittance of {}", source.name));
    if (source.temperature)
      if (const double* fixed_k = std::get_if<double>(&source.temperature->value))
        material.temperature_k = *fixed_k;
    const auto take = [&](const io::SpectrumDocument& curve, const std::string& what) {
      const radiometry::Spectrum spectrum =
          assemble_spectrum(sources_, curve, format("{}{}", what, source.name));
      material.reflectance = source.is_emissivity ? spectrum.complement() : spectrum;
      if (ScatteringAssembly::map_count(source) > 0)
        unscattered_[scene_.materials.size()].push_back(material);
      with_position(sources_, source.position, [&] { scattering_.assemble(source, material); });
    };
    take(source.spectrum, source.further_curves.empty() ? "" : "curve 1 of ");
    scene_.materials.push_back(material);
    const auto own = static_cast<std::uint32_t>(scene_.materials.size() - 1);
    first_further_.push_back(first + static_cast<std::uint32_t>(further.size()));
    material.curve_of = own;
    for (std::size_t k = 0; k < source.further_curves.size(); ++k) {
      take(source.further_curves[k], format("curve {} of ", k + 2));
      further.push_back(material);
    }
    behind_.push_back(own);
    if (const std::shared_ptr<const materials::Bsdf> behind = scene_.materials[own].bsdf->behind()) {
      with_position(sources_, source.position, [&] { check_two_sided(source); });
      materials::Material back = scene_.materials[own];
      back.bsdf = behind;
      back.reflectance = materials::directional_hemispherical(*behind, materials::Side::reflected,
                                                              materials::kBihemispherical);
      back.curve_of = own;
      behind_.back() = first + static_cast<std::uint32_t>(further.size());
      further.push_back(std::move(back));
    }
  }
  scene_.materials.insert(scene_.materials.end(), further.begin(), further.end());
  for (const io::MaterialDocument& source : written_)
    if (source.sides)
      with_position(sources_, source.sides->second.position,
                    [&] { check_sides(source.sides->first, source.sides->second); });
}

std::uint32_t AssignmentAssembly::assignment(const io::MaterialBinding& binding, const std::string& slot_name,
                                             const std::optional<io::TemperatureDocument>& temperature,
                                             const MeshSlot& mesh_slot) {
  scene::SurfaceAssignment assignment;
  std::vector<Surface> surfaces;
  Holes holes_of_file;
  if (const auto* from = std::get_if<std::shared_ptr<const io::FileMaterials>>(&binding.value)) {
    const io::FileMaterials& source = **from;
    const auto instead =
        std::ranges::find(source.slots, slot_name, [](const auto& slot) { return slot.first; });
    if (instead == source.slots.end() && source.colours.empty())
      return with_position(sources_, binding.position,
                           [&] { return coloured(source, mesh_slot, temperature); });
    if (instead != source.slots.end()) {
      surfaces.push_back(surface_of(instead->second, temperature));
    } else {
      with_position(sources_, binding.position, [&] {
        assignment.classes = colours_.classes(source, mesh_slot);
        holes_of_file = colours_.holes(mesh_slot);
      });
      for (const io::FileMaterials::Colour& colour : source.colours)
        surfaces.push_back(surface_of(colour.material, temperature));
    }
  }
  std::visit(
      Overloaded{[&](const io::DocumentName& name) { surfaces.push_back(surface_of(name, temperature)); },
                 [&](const io::MaterialSlots& slots) {
                   const auto found = std::find_if(slots.slots.begin(), slots.slots.end(),
                                                   [&](const auto& slot) { return slot.first == slot_name; });
                   if (found == slots.slots.end()) {
                     std::string names;
                     for (const auto& slot : slots.slots)
                       names += (names.empty() ? "'" : ", '") + slot.first + "'";
                     throw io::document_error(
                         sources_, binding.position,
                         format("no material for slot '{}' of the mesh; the slots given are {}", slot_name,
                                names.empty() ? "none" : names));
                   }
                   surfaces.push_back(surface_of(found->second, temperature));
                 },
                 [&](const io::MaterialMap& map) {
                   with_position(sources_, binding.position, [&] { assignment.classes = class_map(map); });
                   for (const auto& entry : map.classes)
                     surfaces.push_back(surface_of(entry.second, temperature));
                 },
                 [&](const io::MixtureDocument& source) {
                   for (const io::DocumentName& material : source.materials)
                     surfaces.push_back(surface_of(material, temperature));
                   with_position(sources_, binding.position,
                                 [&] { assignment.patterns.push_back(mixture(source, surfaces)); });
                   assignment.states.push_back(surfaces[0].state);
                 },
                 [](const std::shared_ptr<const io::FileMaterials>&) {}},
      binding.value);
  if (assignment.states.empty())
    for (const Surface& surface : surfaces) {
      assignment.states.push_back(surface.state);
      assignment.temperatures.push_back(surface.temperature);
    }
  with_position(sources_, binding.position, [&] {
    check_one_sided(binding, surfaces);
    check_room(binding, surfaces);
    add_holes(assignment, binding, surfaces, holes_of_file);
  });
  add_backs(assignment, surfaces);
  add_patterns(assignment, surfaces);
  return add(std::move(assignment));
}

std::uint32_t AssignmentAssembly::coloured(const io::FileMaterials& source, const MeshSlot& slot,
                                           const std::optional<io::TemperatureDocument>& temperature) {
  if (temperature && std::holds_alternative<io::SolvedTemperatureDocument>(temperature->value))
    throw io::document_error(
        sources_, temperature->position,
        "a temperature cannot be solved for a material of the mesh's file, of which no more is known than "
        "its colour; give the slot a material of the document");
  const double* fixed_k = temperature ? std::get_if<double>(&temperature->value) : nullptr;
  const io::TemperatureMap* map =
      temperature ? std::get_if<io::TemperatureMap>(&temperature->value) : nullptr;
  const FileColours::Surface made =
      colours_.upsampled(source, slot, fixed_k != nullptr ? *fixed_k : 0.0, map != nullptr);
  scene::SurfaceAssignment assignment;
  assignment.states.push_back(made.state);
  if (map != nullptr)
    assignment.temperatures.push_back(
        with_position(sources_, temperature->position, [&] { return temperature_map(*map); }));
  if (made.pattern) assignment.patterns.push_back(made.pattern);
  assignment.cut_out = cut_out(nullptr, {colours_.holes(slot)});
  return add(std::move(assignment));
}

bool AssignmentAssembly::refracts(std::uint32_t material) const {
  return scene_.materials[material].bsdf->passage() == materials::Passage::into;
}

std::vector<bool> AssignmentAssembly::mirrors() const { return scene_.mirror_assignments(); }
std::vector<bool> AssignmentAssembly::lobes() const { return scene_.lobe_assignments(); }

bool AssignmentAssembly::any_medium() const {
  for (std::uint32_t m = 0; m < scene_.materials.size(); ++m)
    if (refracts(m)) return true;
  return false;
}

std::uint32_t AssignmentAssembly::assignment(scene::SurfaceState surface) {
  scene::SurfaceAssignment assignment;
  assignment.states.push_back(state(surface));
  return add(std::move(assignment));
}

AssignmentAssembly::Surface AssignmentAssembly::surface_of(
    const io::DocumentName& material, const std::optional<io::TemperatureDocument>& temperature) {
  const std::uint32_t index = material_index(material.name);
  const auto& sides = written_[index].sides;
  if (!sides) return plain_surface(index, temperature);
  Surface surface = plain_surface(material_index(sides->first.name), temperature);
  surface.back =
      std::make_shared<const Surface>(plain_surface(material_index(sides->second.name), temperature));
  check_faces(surface, *sides);
  if (surface.back->holes && surface.back->material != surface.material)
    throw io::document_error(
        sources_, sides->second.position,
        format("the holes of a sheet are those of its front: '{}' has an 'opacity' map and is its back",
               sides->second.name));
  return surface;
}

AssignmentAssembly::Surface AssignmentAssembly::plain_surface(
    std::uint32_t material, const std::optional<io::TemperatureDocument>& temperature) {
  Surface surface;
  surface.material = material;
  surface.holes = textures_.holes(material);
  const std::optional<io::TemperatureDocument>& source =
      temperature ? temperature : written_[surface.material].temperature;
  if (source) {
    std::visit(Overloaded{[&](double fixed_k) { surface.fixed_k = fixed_k; },
                          [&](const io::TemperatureMap& map) {
                            with_position(sources_, source->position,
                                          [&] { surface.temperature = temperature_map(map); });
                          },
                          [&](io::SolvedTemperatureDocument) {
                            with_position(sources_, source->position, [&] { refuse_solved(material); });
                            scene_.solved.resize(written_.size());
                            surface.solved = material + 1;
                          }},
               source->value);
  }
  surface.state = state(surface, surface.material);
  return surface;
}

std::uint32_t AssignmentAssembly::material_index(const std::string& name) const {
  for (std::size_t m = 0; m < written_.size(); ++m)
    if (written_[m].name == name) return static_cast<std::uint32_t>(m);
  throw InputError(format("there is no material '{}'", name));
}

std::uint32_t AssignmentAssembly::state(const Surface& of, std::uint32_t material) {
  return state({.material = material, .temperature_k = of.fixed_k, .solved = of.solved});
}

std::uint32_t AssignmentAssembly::state(scene::SurfaceState wanted) {
  const auto found = std::find(scene_.states.begin(), scene_.states.end(), wanted);
  const auto index = static_cast<std::uint32_t>(found - scene_.states.begin());
  if (found == scene_.states.end()) scene_.states.push_back(wanted);
  return index;
}

std::uint32_t AssignmentAssembly::add(scene::SurfaceAssignment assignment) {
  const bool mapped = std::any_of(assignment.temperatures.begin(), assignment.temperatures.end(),
                                  [](const auto& map) { return map != nullptr; });
  if (!mapped) assignment.temperatures.clear();
  for (std::size_t k = 0; k < scene_.assignments.size(); ++k)
    if (scene_.assignments[k] == assignment) return static_cast<std::uint32_t>(k);
  scene_.assignments.push_back(std::move(assignment));
  return static_cast<std::uint32_t>(scene_.assignments.size() - 1);
}

}  // namespace ifov::session
