#pragma once

#include "core/run_control.h"
#include "geometry/terrain_mesh.h"
#include "io/document/document.h"
#include "session/map_frame.h"

namespace ifov::session {

/// Reads a terrain and meshes it: metres about the scene's origin, subtracted in double. Says how many triangles it
/// has, how true they are, and what became of cells without a height.
geometry::TriangleMesh assemble_terrain(const io::TerrainShape& source, const MapFrame& frame, LogSink* log);

}  // namespace ifov::session
