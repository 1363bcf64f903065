#pragma once

#include <string>
#include <vector>

#include "core/run_control.h"
#include "scene/scene.h"
#include "session/assembly/geometry/placed_objects.h"
#include "session/assembly/shared/map_scale.h"

namespace ifov::io {
struct Document;
class SceneCache;
}  // namespace ifov::io

namespace ifov::session {

/// Builds the scene that a document describes: reads its meshes, maps and spectra, and lists the maps that lie on it by
/// place. `log` and `cache` may be null.
struct AssembledScene {
  scene::Scene scene;
  std::vector<MapScale> map_scales;
  PlacedObjects placed;
  math::Vec3 map_offset_m;  ///< map coordinates of the scene's origin
};
AssembledScene assemble_scene(const io::Document& document, LogSink* log, io::SceneCache* cache = nullptr);

}  // namespace ifov::session
