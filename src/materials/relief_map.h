#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "materials/map_grid.h"
#include "math/vec3.h"

namespace ifov::materials {

/// Relief too fine for the geometry, draped from above: it tilts the shading normal and moves nothing.
class ReliefMap {
 public:
  /// From heights in metres above the surface: slopes are those of the bilinear surface through the middles of the
  /// cells. Throws InputError where a height is not finite or the map goes by texture coordinates, whose directions on
  /// the surface are not known.
  static ReliefMap from_heights(MapGrid grid, std::span<const float> height_m);

  /// From normals (x east, y north, z up, any length), three bands row by row. Throws InputError where a normal does
  /// not point up.
  static ReliefMap from_normals(MapGrid grid, std::span<const float> normals);

  /// The normal of a surface with this normal and the relief on it: unit. With the slopes p = dh/dx and q = dh/dy the
  /// surface z = f + h has the normal (n_x - p n_z, n_y - q n_z, n_z), normalised (Blinn 1978, with displacement
  /// upwards instead of along the normal). Walls are left as they are.
  math::Normal3 tilted(math::Normal3 normal, const MapPosition& position) const;

  const MapGrid& grid() const { return grid_; }

 private:
  ReliefMap(MapGrid grid, std::vector<float> numbers, bool heights);
  MapGrid grid_;
  std::vector<float> numbers_;  ///< heights, or slopes to the east and to the north in turn
  bool heights_;
};

}  // namespace ifov::materials
