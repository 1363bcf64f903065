#pragma once

#include <memory>
#include <span>

#include "core/run_control.h"
#include "session/assembly/geometry/placed_objects.h"

namespace ifov::geometry {
class World;
}
namespace ifov::io {
struct DocumentSources;
class SceneCache;
struct ObjectDocument;
struct PrototypeDocument;
}  // namespace ifov::io

namespace ifov::session {

class AssignmentAssembly;
class MapFrame;
struct PlacedLamp;

/// A document's objects, and the prototypes that they are copies of, and then the lamps, about the scene's origin; what covers
/// them is asked of `assignments`. Meshes and lists are kept in `cache` from run to run; it, `log` and `progress`, which is told of objects in place of pixels, may be null.
/// Throws InputError with the place in the document. `placed` takes down which of its objects stand for which of the document's.
std::unique_ptr<geometry::World> assemble_geometry(const io::DocumentSources& sources,
                                                   std::span<const io::ObjectDocument> objects,
                                                   std::span<const io::PrototypeDocument> prototypes,
                                                   AssignmentAssembly& assignments,
                                                   std::span<const PlacedLamp> lamps, const MapFrame& frame,
                                                   LogSink* log, io::SceneCache* cache, PlacedObjects& placed,
                                                   ProgressSink* progress = nullptr);

}  // namespace ifov::session
