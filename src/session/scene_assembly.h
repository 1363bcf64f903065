#pragma once

#include <string>

#include "core/run_control.h"
#include "io/document/document.h"
#include "io/scene_cache/scene_cache.h"
#include "scene/scene.h"

namespace ifov::session {

/// Builds the scene that a document describes: reads its meshes, maps and spectra. `log` and
/// `cache` may be null.
scene::Scene assemble_scene(const io::Document& document, LogSink* log, io::SceneCache* cache = nullptr);

}  // namespace ifov::session
