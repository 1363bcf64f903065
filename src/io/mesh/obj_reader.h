#pragma once

#include <filesystem>

#include "core/run_control.h"
#include "geometry/triangle_mesh.h"
#include "io/mesh/mesh_format.h"

namespace ifov::io {

/// Reads a Wavefront OBJ file: vertices, faces (polygons are cut into triangles, concave ones too), texture
/// coordinates, normals, and the names after `usemtl` as material slots in order of first use (faces before
/// the first `usemtl` get a slot without a name). Indices may refer to what stands above them only. `.mtl`
/// files are ignored with a word to `log` (may be null), lines and curves without; a name that no face uses
/// makes a slot all the same. Coordinates are kept in double. Throws InputError with file and line for
/// anything broken, SystemError if the file cannot be read.
geometry::TriangleMesh read_obj(const std::filesystem::path& path, LogSink* log = nullptr,
                                MeshUse use = MeshUse::shape);

extern const MeshFormat kObj;

}  // namespace ifov::io
