#include "materials/relief_map.h"

#include <cmath>

#include "core/error.h"

namespace ifov::materials {

ReliefMap::ReliefMap(MapGrid grid, std::vector<float> numbers, bool heights)
    : grid_(grid), numbers_(std::move(numbers)), heights_(heights) {
  check(grid_, heights_ ? numbers_.size() : numbers_.size() / 2, "a relief map");
  if (grid_.by == MapBy::texture_coordinates)
    throw InputError(
        "a relief map lies on the scene by place: the directions of texture coordinates on a surface are not known");
}

ReliefMap ReliefMap::from_heights(MapGrid grid, std::span<const float> height_m) {
  for (std::size_t k = 0; k < height_m.size(); ++k)
    if (!std::isfinite(height_m[k])) throw InputError(format("the relief has no height in cell {}", k + 1));
  return ReliefMap(grid, {height_m.begin(), height_m.end()}, true);
}

ReliefMap ReliefMap::from_normals(MapGrid grid, std::span<const float> normals) {
  const std::size_t cells = grid.cell_count();
  if (normals.size() != 3 * cells)
    throw InputError(
        format("a map of {} normals needs {} numbers: found {}", cells, 3 * cells, normals.size()));
  std::vector<float> slopes;
  slopes.reserve(2 * cells);
  for (std::size_t k = 0; k < cells; ++k) {
    const float x = normals[k], y = normals[cells + k], z = normals[2 * cells + k];
    if (!(z > 0.0f) || !std::isfinite(x) || !std::isfinite(y))
      throw InputError(
          format("the normal in cell {} is ({:g}, {:g}, {:g}); it must point up", k + 1, x, y, z));
    slopes.push_back(-x / z);
    slopes.push_back(-y / z);
  }
  return ReliefMap(grid, std::move(slopes), false);
}

math::Normal3 ReliefMap::tilted(math::Normal3 normal, const MapPosition& position) const {
  double p = 0.0, q = 0.0;
  const MapGrid::Corners corners = grid_.corners_at(position);
  if (heights_) {
    const auto height = [&](int k) { return static_cast<double>(numbers_[corners.cell[k]]); };
    const double down = corners.share[2] + corners.share[3], across = corners.share[1] + corners.share[3];
    p = ((1.0 - down) * (height(1) - height(0)) + down * (height(3) - height(2))) / grid_.cell_width_m;
    q = ((1.0 - across) * (height(0) - height(2)) + across * (height(1) - height(3))) / grid_.cell_height_m;
  } else {
    for (int k = 0; k < 4; ++k) {
      p += corners.share[k] * static_cast<double>(numbers_[2 * corners.cell[k]]);
      q += corners.share[k] * static_cast<double>(numbers_[2 * corners.cell[k] + 1]);
    }
  }
  return math::as_normal(math::normalized({normal.x - p * normal.z, normal.y - q * normal.z, normal.z}));
}

}  // namespace ifov::materials
