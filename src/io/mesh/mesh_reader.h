#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "geometry/triangle_mesh.h"
#include "io/mesh/mesh_format.h"

namespace ifov::io {

/// The file name extensions of the mesh formats that are read, in small letters: ".obj", ".ply", ".gltf",
/// ".glb".
std::vector<std::string> mesh_extensions();

/// Whether the format itself says that y points up (glTF); the others leave it open.
bool format_has_y_up(const std::filesystem::path& path);

/// Files beside a mesh that its reader opens as well; none where it refuses the mesh.
std::vector<std::string> further_mesh_files(const std::filesystem::path& path);

/// Reads a mesh, of an asset's name the one in memory, with the reader that its extension (of either case) names; what the file holds and is not
/// used is told to `log` (may be null). Throws InputError for an extension that is not known, a mesh without
/// triangles and whatever the reader finds; SystemError if the file cannot be read.
geometry::TriangleMesh read_mesh(const std::filesystem::path& path, LogSink* log = nullptr,
                                 MeshUse use = MeshUse::shape);

}  // namespace ifov::io
