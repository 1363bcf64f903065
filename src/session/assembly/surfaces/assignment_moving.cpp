// What must not cover an object that moves.

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
    if (cover.classes || !cover.temperatures.empty() || !cover.back_temperatures.empty() ||
        !cover.patterns.empty() || cover.cut_out)
      refuse(
          cover,
          "it has a map or texture (of classes, temperatures, reflectances, holes), which is tied to places of the "
          "scene; expected one material at one temperature for each part");
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
