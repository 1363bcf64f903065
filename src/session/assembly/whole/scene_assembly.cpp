#include "session/assembly/whole/scene_assembly.h"

#include <algorithm>

#include "geometry/periodic_world.h"
#include "geometry/world.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/scene_document.h"
#include "io/scene_cache/scene_cache.h"
#include "session/assembly/geometry/geometry_assembly.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/assignment_assembly.h"
#include "session/assembly/surfaces/lamp_assembly.h"

namespace ifov::session {

std::string scene_statement(const geometry::World& world) {
  const geometry::World::Storage kept = world.storage();
  std::string text = format("scene: {} objects, {} triangles, {:.1f} MB", world.object_count(),
                            world.triangle_count(), static_cast<double>(kept.bytes) / 1e6);
  if (kept.instances > 0)
    text += format("; {} instances of {} triangles{}", kept.instances, kept.stored_triangles,
                   kept.instance_table ? " in a table" : "");
  if (kept.chunks > 0)
    text += format("; {} chunks of large meshes, each built when a ray comes near", kept.chunks);
  if (kept.prototypes_apart > 0)
    text += format("; {} prototypes of prototypes stand part by part", kept.prototypes_apart);
  return text;
}

AssembledScene assemble_scene(const io::DocumentSources& sources, const io::SceneDocument& written,
                              std::span<const io::LampDocument> lamps,
                              const std::optional<geodesy::UtcTime>& time, const io::CameraDocument& camera,
                              std::uint64_t seed, LogSink* log, io::SceneCache* cache,
                              ProgressSink* progress) {
  AssembledScene assembled;
  scene::Scene& scene = assembled.scene;
  const MapFrame frame(sources, written.origin);
  assembled.map_offset_m = frame.offset_m();
  AssignmentAssembly assignments(sources, written.materials, seed, frame, scene, log);
  const std::vector<PlacedLamp> placed = assemble_lamps(sources, lamps, frame, scene);
  const io::CameraSettings::Exposed exposed =
      camera.settings ? camera.settings->exposed() : io::CameraSettings::Exposed{};
  const GeometrySubject geometry{sources,        written.objects, written.prototypes, time,
                                 written.origin, exposed.from_s,  exposed.to_s};
  std::unique_ptr<geometry::World> world =
      assemble_geometry(geometry, assignments, placed, frame, log, cache, assembled.placed, progress);
  std::unique_ptr<geometry::World> departed;
  assembled.map_scales = assignments.map_scales();
  assembled.colour_guesses = assignments.colour_guesses();
  if (std::any_of(scene.states.begin(), scene.states.end(),
                  [](const auto& state) { return state.solved > 0; })) {
    // What nobody sees covers nothing.
    const std::size_t materials = scene.materials.size(), states = scene.states.size(),
                      covers = scene.assignments.size();
    departed = assemble_departed(geometry, assignments, frame, log, cache);
    scene.materials.resize(materials), scene.states.resize(states), scene.assignments.resize(covers);
  }
  if (written.periodic) {
    const io::PeriodicDocument& periodic = *written.periodic;
    geometry::PeriodicWorld::Cell cell{-0.5 * periodic.width_m, -0.5 * periodic.height_m, periodic.width_m,
                                       periodic.height_m};
    if (periodic.low_left_m) {
      cell.west_m = (*periodic.low_left_m)[0] - written.origin.offset_m.x;
      cell.south_m = (*periodic.low_left_m)[1] - written.origin.offset_m.y;
    }
    for (std::unique_ptr<geometry::World>* const one : {&world, &departed})
      if (*one)
        *one = with_position(sources, periodic.position, [&] {
          return std::make_unique<geometry::PeriodicWorld>(std::move(*one), cell);
        });
  }
  scene.world = std::move(world), scene.departed = std::move(departed);
  return assembled;
}

}  // namespace ifov::session
