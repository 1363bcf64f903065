#pragma once

#include <filesystem>

#include "geometry/triangle_mesh.h"
#include "io/mesh/mesh_format.h"

namespace ifov::io {

/// Reads a PLY file, ASCII or binary of either byte order: the element `vertex` with x, y, z and, where they
/// are there, nx, ny, nz and texture coordinates (s, t; u, v; texture_u, texture_v; texture_s, texture_t);
/// the element `face` with the list vertex_indices (or vertex_index) and, where it is there, the list
/// `texcoord` of two numbers per corner; the element `tristrips`. Polygons are cut into triangles. Other
/// elements and properties are skipped. Coordinates are kept in double. A file of points alone gives a mesh
/// without triangles. Throws InputError with file and line (binary: byte) for anything broken,
/// SystemError if the file cannot be read.
geometry::TriangleMesh read_ply(const std::filesystem::path& path);

extern const MeshFormat kPly;

}  // namespace ifov::io
