#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "geometry/world.h"

namespace ifov::geometry {

/// A part of a large mesh that lies together in space: `count` entries of the mesh's order from `first` on, and the box
/// of their vertices.
struct MeshChunk {
  World::Bounds bounds{};
  std::uint32_t first = 0, count = 0;
  friend bool operator==(const MeshChunk& a, const MeshChunk& b) {
    return a.bounds.low_m == b.bounds.low_m && a.bounds.high_m == b.bounds.high_m && a.first == b.first &&
           a.count == b.count;
  }
};

/// The lists of a mesh (see TriangleMesh) where they lie, in vectors or in a file. Copies share them.
struct MeshLists {
  std::span<const math::Point3> vertices_m;
  std::span<const Triangle> triangles;
  std::span<const std::uint32_t> slots;
  std::span<const math::Normal3> normals;
  std::span<const Triangle> normal_corners;
  std::span<const Uv> uvs;
  std::span<const Triangle> uv_corners;
  std::span<const std::uint32_t> patches;  ///< the smooth patch of every triangle
  std::span<const std::uint32_t> order;    ///< every triangle once, chunk by chunk; empty without chunks
  std::span<const MeshChunk> chunks;       ///< empty: the mesh is not divided
  std::vector<std::string> slot_names;
  std::shared_ptr<const void> keeper;  ///< of what the lists lie in
};

/// The lists of a mesh that outlives them, without patches.
MeshLists lists_of(const TriangleMesh& mesh);

/// The lists of a mesh, which they keep from now on.
MeshLists keep_mesh(TriangleMesh mesh, std::vector<std::uint32_t> patches);

}  // namespace ifov::geometry
