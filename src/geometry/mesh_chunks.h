#pragma once

#include <cstddef>

#include "geometry/mesh_lists.h"

namespace ifov::geometry {

/// Most triangles of a chunk. More cost the first ray that comes near more time, fewer cost every ray more.
inline constexpr std::size_t kMostInChunk = 65536;

/// Divides a mesh of more triangles than a chunk holds, others are left as they are: halves of equal numbers along the
/// longest side of the box of the triangles' middles, until they are small enough. The result depends on the mesh
/// alone.
void divide(MeshLists& mesh);

}  // namespace ifov::geometry
