#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/terrain_mesh.h"
#include "geometry/world.h"
#include "math/transform.h"

namespace ifov::geometry {

/// A terrain that is traced as it lies in its raster, two triangles to a cell that are never stored: four
/// bytes a height, and nothing to build but the range of heights in blocks of cells. The surface is that of
/// mesh_terrain() with a detail of 0: a cell is halved along the diagonal between its corners with both
/// coordinates even or both odd. Cells with an unknown corner are open where their triangles meet it.
///
/// Its own frame, in which everything is met, has x along the columns and y along the rows, in cells from the
/// first node, and z in metres.
class HeightField {
 public:
  /// `smooth`: shading normals by differences over the neighbours in the grid. Throws InputError for grids
  /// that are not regular, have less than 2 x 2 nodes, more than 2^31 cells, or no triangle with three known
  /// heights.
  HeightField(TerrainGrid grid, bool smooth);

  const math::Transform& object_from_field() const { return object_from_field_; }
  World::Bounds bounds() const { return bounds_; }  ///< in the object's frame
  math::Point3 middle() const { return middle_; }   ///< a node about the middle, object's frame
  std::uint64_t triangles() const {
    return 2 * static_cast<std::uint64_t>(grid_.columns - 1) * (grid_.rows - 1);
  }
  std::size_t bytes() const {
    return grid_.height_m.capacity() * sizeof(float) + ranges_.capacity() * sizeof(Range);
  }

  std::uint32_t blocks() const { return static_cast<std::uint32_t>(blocks_across_ * blocks_down_); }
  /// In the field's frame; empty (low above high) where nothing is known in the block.
  World::Bounds block_bounds(std::uint32_t block) const;

  /// Where a line p + t d of the field's frame meets the triangles of a block.
  struct Hit {
    double t = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;  ///< 2 * cell + half
  };
  /// The smallest t between the limits. The surface within a block is watertight: each crossing is seen as a
  /// change of side between places that neighbouring triangles share.
  Hit meet(std::uint32_t block, math::Point3 p, math::Vec3 d, double t_min, double t_max) const;

  /// Upward normals in the field's frame, any length: of a triangle, and as light sees it at a point of it.
  math::Normal3 normal(std::uint32_t triangle) const;
  math::Normal3 shading_normal(std::uint32_t triangle, math::Point3 at) const;

 private:
  static constexpr int kBlock = 16;  // cells along its side
  struct Range {
    float low_m, high_m;
  };
  /// z = height + along_x * (x - column) + along_y * (y - row) over half a cell.
  struct Plane {
    double height_m, along_x, along_y;
  };

  double height(int column, int row) const {
    return static_cast<double>(grid_.height_m[grid_.index(column, row)]);
  }
  static bool falling(int column, int row) { return (column + row) % 2 == 0; }
  Plane plane(int column, int row, int half) const;
  std::array<double, 2> slope(int column, int row) const;

  TerrainGrid grid_;
  bool smooth_;
  int blocks_across_, blocks_down_;
  std::vector<Range> ranges_;
  math::Transform object_from_field_, field_from_object_;
  World::Bounds bounds_{};
  math::Point3 middle_;
};

}  // namespace ifov::geometry
