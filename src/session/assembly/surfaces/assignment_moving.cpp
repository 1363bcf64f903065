// What must not cover an object that moves.

#include <algorithm>

#include "materials/numbered_map.h"
#include "scene/scene.h"
#include "session/assembly/surfaces/assignment_assembly.h"

namespace ifov::session {

std::size_t AssignmentAssembly::count() const { return scene_.assignments.size(); }

void AssignmentAssembly::refuse_moving(const std::vector<bool>& covers) const {
  const std::vector<bool> mirrors = this->mirrors(), lobes = this->lobes();
  const auto refuse = [&](const scene::SurfaceAssignment& cover, const char* why) {
    const std::uint32_t state = cover.states.empty() ? 0 : cover.states[0];
    throw InputError(format("what covers it, '{}', cannot move yet: {}",
                            scene_.materials[scene_.states[state].material].name, why));
  };
  for (std::uint32_t a = 0; a < scene_.assignments.size(); ++a) {
    if (a >= covers.size() || !covers[a]) continue;
    const scene::SurfaceAssignment& cover = scene_.assignments[a];
    if (cover.cut_out) refuse(cover, "it has holes by a map; expected a shape that has them");
    if (cover.bends_normals())
      refuse(cover,
             "its normals are tilted by a map or a texture, in the scene's axes; expected none of these");
    const std::vector<const materials::NumberedMap*> maps = cover.maps();
    const bool unmapped = !cover.classes && cover.temperatures.empty() && cover.back_temperatures.empty() &&
                          cover.patterns.empty();
    // What tells no map may go by places all the same.
    const bool told = std::all_of(cover.patterns.begin(), cover.patterns.end(), [](const auto& pattern) {
      std::vector<const materials::NumberedMap*> own;
      pattern->add_maps(own);
      return !own.empty();
    });
    const bool carried = told && std::all_of(maps.begin(), maps.end(), [](const auto* map) {
                           return map->grid().by == materials::MapBy::texture_coordinates;
                         });
    if (!unmapped && !carried)
      refuse(
          cover,
          "it has a map or texture (of classes, temperatures, reflectances) by x and y, which is tied to places of the scene; expected one "
          "by texture coordinates, or one material at one temperature for each part");
    if (a < mirrors.size() && mirrors[a])
      refuse(
          cover,
          "it is smooth, and light that mirrors throw is sought from where they stand; expected rough surfaces");
    if (a < lobes.size() && lobes[a])
      refuse(cover,
             "it is glossy, and its highlights are sought from where it stands; expected rough surfaces");
    for (const auto* states : {&cover.states, &cover.back_states})
      for (const std::uint32_t s : *states) {
        if (scene_.states[s].solved > 0)
          refuse(
              cover,
              "its temperature is solved from what the Sun did to it where it stands; expected a 'temperature'");
        if (scene_.states[s].lamp > 0) refuse(cover, "it is a lamp");
      }
  }
}

}  // namespace ifov::session
