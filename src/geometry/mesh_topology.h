#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace ifov::geometry {

/// Facets meet without a crease where their normals differ by less than this.
inline constexpr double kCreaseAngleDeg = 30.0;

/// How the triangles of a mesh hang together. Vertices at the same position count as one.
struct MeshTopology {
  /// The smooth patch of every triangle: joined across shared edges that are no creases. Numbered from 0 in
  /// order of their first triangle.
  std::vector<std::uint32_t> patches;
  std::uint32_t patch_count = 0;

  /// The mesh bounds a volume: every edge is shared by exactly two triangles that run along it in opposite
  /// ways.
  bool closed = false;

  /// A heap of small things such as leaves: at most one triangle in twenty hangs together with more than two
  /// others.
  bool loose = false;
};
MeshTopology topology_of(std::span<const math::Point3> vertices_m, std::span<const Triangle> triangles);

}  // namespace ifov::geometry
