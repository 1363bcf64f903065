#pragma once

#include <vector>

#include "core/run_control.h"
#include "geometry/world.h"
#include "io/document/scene_document.h"
#include "io/instances/instance.h"
#include "session/assembly/shared/map_frame.h"

namespace ifov::io {
struct DocumentSources;
}

namespace ifov::session {

/// Copies at random, for each prototype of `source.of` a list, in the coordinates of the document. `ground`
/// is what they stand on, in those of the scene; null: they stand at the document's height. Says in the log
/// how dense they stand; warns where the minimum distance does not allow the density that is asked for, and
/// of places without ground.
std::vector<std::vector<io::Instance>> random_copies(const io::DocumentSources& sources,
                                                     const io::RandomPlacement& source, const MapFrame& frame,
                                                     const geometry::World* ground, LogSink* log);

}  // namespace ifov::session
