#pragma once

#include <memory>
#include <span>

#include "core/run_control.h"
#include "session/assembly/geometry/placed_objects.h"

namespace ifov::geometry {
class World;
}
namespace ifov::io {
struct Document;
class SceneCache;
}  // namespace ifov::io

namespace ifov::session {

class AssignmentAssembly;
class MapFrame;
struct PlacedLamp;

/// All that stands in a document's scene, about its origin, and then the lamps; what covers it is asked of `assignments`. Meshes
/// and lists are kept in `cache` from run to run; it and `log` may be null. Throws InputError with the place
/// in the document. `placed` takes down which of its objects stand for which of the document's.
std::unique_ptr<geometry::World> assemble_geometry(const io::Document& document,
                                                   AssignmentAssembly& assignments,
                                                   std::span<const PlacedLamp> lamps, const MapFrame& frame,
                                                   LogSink* log, io::SceneCache* cache,
                                                   PlacedObjects& placed);

}  // namespace ifov::session
