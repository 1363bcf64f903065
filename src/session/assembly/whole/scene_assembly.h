#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "geodesy/utc_time.h"
#include "scene/scene.h"
#include "session/assembly/geometry/placed_objects.h"
#include "session/assembly/shared/colour_guess.h"
#include "session/assembly/shared/map_scale.h"

namespace ifov::io {
struct CameraDocument;
struct DocumentSources;
struct LampDocument;
class SceneCache;
struct SceneDocument;
}  // namespace ifov::io

namespace ifov::session {

/// A scene with its lamps, without other light yet.
struct AssembledScene {
  scene::Scene scene;
  std::vector<MapScale> map_scales;
  std::vector<ColourGuess> colour_guesses;
  PlacedObjects placed;
  math::Vec3 map_offset_m;  ///< map coordinates of the scene's origin
};
/// Builds what a document's scene consists of at `time`, and while the image of `camera` is exposed, if it has settings: reads its meshes, maps and spectra, lists the maps on it by place. `seed` as
/// of TextureAssembly; `log`, `cache` and `progress` (of objects in place of pixels) may be null.
AssembledScene assemble_scene(const io::DocumentSources& sources, const io::SceneDocument& written,
                              std::span<const io::LampDocument> lamps,
                              const std::optional<geodesy::UtcTime>& time, const io::CameraDocument& camera,
                              std::uint64_t seed, LogSink* log, io::SceneCache* cache = nullptr,
                              ProgressSink* progress = nullptr);

std::string scene_statement(const geometry::World& world);  ///< what stands there, how it is kept

}  // namespace ifov::session
