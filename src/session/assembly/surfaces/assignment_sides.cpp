// Surfaces that look otherwise from behind.

#include "materials/bsdf/bsdf.h"
#include "scene/scene.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/assignment_assembly.h"
#include "session/assembly/surfaces/two_faces.h"

namespace ifov::session {

void AssignmentAssembly::check_sides(const io::DocumentName& front_name,
                                     const io::DocumentName& back_name) const {
  const std::uint32_t front = material_index(front_name.name), back = material_index(back_name.name);
  for (const std::uint32_t side : {front, back})
    if (behind_[side] != side)
      throw InputError(format(
          "'{}' is seen otherwise from behind itself ('{}') and cannot be a side: give it to objects alone",
          scene_.materials[side].name, written_[side].scattering.model));
  const auto lets_through = [&](std::uint32_t m, double um) {
    const auto& transmittance = scene_.materials[m].transmittance;
    return transmittance ? transmittance->at(um) : 0.0;
  };
  const bool through_front = scene_.materials[front].transmittance.has_value(),
             through_back = scene_.materials[back].transmittance.has_value();
  if (through_front != through_back)
    throw InputError(format(
        "light comes through '{}' and not through '{}': the sides of a sheet let through the same",
        through_front ? front_name.name : back_name.name, through_front ? back_name.name : front_name.name));
  if (!through_front) return;
  if (scene_.materials[front].bsdf->passage() != scene_.materials[back].bsdf->passage())
    throw InputError(format("light goes straight through one of '{}' and '{}' and is spread by the other",
                            front_name.name, back_name.name));
  constexpr double kSame = 1e-3;
  const radiometry::Spectrum* both[] = {&*scene_.materials[front].transmittance,
                                        &*scene_.materials[back].transmittance};
  std::vector<double> um = radiometry::common_wavelengths(both).um;
  if (um.empty()) um.push_back(1.0);
  for (const double at : um) {
    const double of_front = lets_through(front, at), of_back = lets_through(back, at);
    if (std::abs(of_front - of_back) > kSame)
      throw InputError(format(
          "'{}' lets through {:.4g}{} and '{}' {:.4g}: through a sheet as much goes one way as the other (reciprocity)",
          front_name.name, of_front, um.size() > 1 ? format(" at {:g} um", at) : "", back_name.name,
          of_back));
  }
}

void AssignmentAssembly::refuse_solved(std::uint32_t material) const {
  const materials::Material& optics = scene_.materials[material];
  if (optics.bsdf->passage() != materials::Passage::none)
    throw InputError(format("the temperature of '{}' cannot be solved: light goes through it", optics.name));
  if (optics.transmittance && !has_two_faces(written_[material]))
    throw InputError(format(
        "the temperature of '{}' cannot be solved: light goes through it, and it is not told to be a sheet "
        "of two faces; give \"thermal\": {{\"leaf\": {{}}}}, or layers with \"back\": {{\"other_side\": {{}}}}",
        optics.name));
}

void AssignmentAssembly::check_faces(const Surface& surface,
                                     const std::pair<io::DocumentName, io::DocumentName>& sides) const {
  if (surface.solved > 0 && surface.back->material != surface.material &&
      (has_two_faces(written_[surface.material]) || has_two_faces(written_[surface.back->material])))
    throw io::document_error(
        sources_, sides.second.position,
        format(
            "a sheet whose faces are both outdoors has the same material on either, and its sides are '{}' and '{}': "
            "give one of them, or both a \"back\" other than \"other_side\"",
            sides.first.name, sides.second.name));
}

void AssignmentAssembly::add_backs(scene::SurfaceAssignment& assignment,
                                   const std::vector<Surface>& surfaces) {
  const bool any = std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    return surface.back || behind_[surface.material] != surface.material;
  });
  if (!any || assignment.states.size() != surfaces.size()) return;
  bool mapped = false;
  for (const Surface& surface : surfaces) {
    const Surface back = seen_from_behind(surface);
    assignment.back_states.push_back(back.state);
    assignment.back_temperatures.push_back(back.temperature);
    mapped = mapped || back.temperature != surface.temperature;
  }
  if (!mapped) assignment.back_temperatures.clear();
}

AssignmentAssembly::Surface AssignmentAssembly::seen_from_behind(const Surface& surface) {
  if (surface.back) return *surface.back;
  Surface back = surface;
  back.material = behind_[surface.material];
  back.state = state(surface, back.material);
  return back;
}

void AssignmentAssembly::check_one_sided(const io::MaterialBinding& binding,
                                         const std::vector<Surface>& surfaces) const {
  if (!std::holds_alternative<io::MixtureDocument>(binding.value)) return;
  for (const Surface& surface : surfaces)
    if (surface.back || behind_[surface.material] != surface.material)
      throw InputError(format(
          "a mixture cannot hold '{}', which is seen otherwise from its inner side; a map of classes can",
          scene_.materials[surface.material].name));
}

}  // namespace ifov::session
