#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/run_control.h"
#include "session/assembly/geometry/placed_objects.h"

namespace ifov::geodesy {
struct UtcTime;
}
namespace ifov::geometry {
class World;
}
namespace ifov::io {
struct DocumentSources;
class SceneCache;
struct ObjectDocument;
struct OriginDocument;
struct PrototypeDocument;
}  // namespace ifov::io

namespace ifov::session {

class AssignmentAssembly;
class MapFrame;
struct PlacedLamp;

/// The parts of a document that geometry is made of. Members must outlive what is asked with it.
struct GeometrySubject {
  const io::DocumentSources& sources;
  std::span<const io::ObjectDocument> objects;
  std::span<const io::PrototypeDocument> prototypes;
  const std::optional<geodesy::UtcTime>& time;  ///< of the picture
  const io::OriginDocument& origin;
  double from_s = 0.0, to_s = 0.0;  ///< of the image's exposure: paths of what moves are to cover it
};

/// A document's objects that are there at its time, and the prototypes that they are copies of, and then the lamps, about the scene's origin;
/// what covers them is asked of `assignments`. Meshes and lists are kept in `cache` from run to run; it, `log` and `progress`, which is told of
/// objects in place of pixels, may be null.
/// Throws InputError with the place in the document. `placed` takes down which of its objects stand for which of the document's.
std::unique_ptr<geometry::World> assemble_geometry(const GeometrySubject& of, AssignmentAssembly& assignments,
                                                   std::span<const PlacedLamp> lamps, const MapFrame& frame,
                                                   LogSink* log, io::SceneCache* cache, PlacedObjects& placed,
                                                   ProgressSink* progress = nullptr);

/// The objects that are there at other times alone, for rays of those times; null where there are none. Surface assignments of
/// theirs are added to those of the scene.
std::unique_ptr<geometry::World> assemble_departed(const GeometrySubject& of, AssignmentAssembly& assignments,
                                                   const MapFrame& frame, LogSink* log,
                                                   io::SceneCache* cache);

}  // namespace ifov::session
