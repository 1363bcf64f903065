#pragma once

#include "core/run_control.h"
#include "math/transform.h"

namespace ifov::geometry {
class WorldBuilder;
}
namespace ifov::io {
struct DocumentSources;
struct ObjectDocument;
}  // namespace ifov::io

namespace ifov::session {

class AssignmentAssembly;
class MapFrame;

/// Reads the city model of an object and places each of its buildings, roads and so on as an object of its
/// own. `scene_from_document` takes map coordinates (after the object's transform) to the scene. Coordinates
/// in another projection than the scene's are taken over where both are stated. Tells `log` (may be null)
/// what was read and what was left out. Throws InputError.
void place_city(const io::DocumentSources& sources, const io::ObjectDocument& object,
                const math::Transform& scene_from_document, const MapFrame& frame,
                AssignmentAssembly& assignments, geometry::WorldBuilder& builder, LogSink* log);

}  // namespace ifov::session
