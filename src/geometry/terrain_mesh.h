#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace ifov::geometry {

/// Heights at the nodes of a grid, rows from the north. The nodes stand where `west_m` and its companions put
/// them, or, in a grid that is not regular on the map, where `positions_m` says.
struct TerrainGrid {
  int columns = 0, rows = 0;
  std::vector<float> height_m;  ///< [row * columns + column]; NaN: nothing known there
  math::Point3 corner_m;        ///< of the first node; its z is added to all heights
  math::Vec3 along_column_m{1.0, 0.0, 0.0}, along_row_m{0.0, -1.0, 0.0};  ///< steps between nodes
  std::vector<std::array<double, 2>> positions_m;  ///< x and y of every node; empty: regular

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  math::Point3 node(int column, int row) const;
};

/// A mesh of a terrain and how true it is to its grid.
struct TerrainMesh {
  TriangleMesh mesh;  ///< faces up; triangles with an unknown corner are left out
  std::size_t known_nodes = 0;
  /// Largest distances of a known node of the grid from the mesh: in height, and on the map (0 for regular
  /// grids).
  double largest_height_error_m = 0.0, largest_shift_m = 0.0;
};

/// Meshes a grid by right triangles that are halved until every known node lies within `detail_m` of the mesh, in
/// height and (irregular grids) on the map; 0 keeps every node that does not lie exactly in a coarser triangle.
/// Neighbours share whole edges: there are no cracks. (Evans, Kirkpatrick and Townsend 2001, Right-triangulated
/// irregular networks, Algorithmica 30; here a halving is decided by the largest deviation of any node inside
/// the two triangles that it halves, so that the bound is kept and not estimated.) `smooth`: with vertex normals
/// by differences over the neighbours in the grid. Throws InputError where the grid has less than 2 x 2 nodes or
/// no triangle is known.
TerrainMesh mesh_terrain(const TerrainGrid& grid, double detail_m, bool smooth);

}  // namespace ifov::geometry
