#pragma once

#include <memory>

#include "core/run_control.h"
#include "geometry/body.h"
#include "geometry/height_field.h"
#include "io/document/scene_document.h"
#include "session/assembly/shared/map_frame.h"

namespace ifov::io {
class SceneCache;
}

namespace ifov::session {

/// Reads a terrain and meshes it: metres about the scene's origin, subtracted in double. Says how many
/// triangles it has, how true they are, and what became of cells without a height. Kept in `cache` from run
/// to run; it and `log` may be null.
geometry::Body assemble_terrain(const io::TerrainShape& source, const MapFrame& frame, io::SceneCache* cache,
                                LogSink* log);

/// Whether a terrain is traced in its raster: where its document says so and, where it says nothing, where that is
/// possible and a mesh would be large. `in_prototype`: among the objects of a prototype, which only a mesh can be.
bool is_traced_in_raster(const io::TerrainShape& source, const MapFrame& frame, bool in_prototype);

/// The same for a terrain that is traced in its raster; read anew in every run, since there is nothing to
/// make of it.
std::shared_ptr<const geometry::HeightField> assemble_height_field(const io::TerrainShape& source,
                                                                   const MapFrame& frame, LogSink* log);

}  // namespace ifov::session
