#include "materials/map_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::materials {

namespace {

/// Index within the map of cell `n` of the tiled plane. Stays a double until it is small: an int may not hold `n`.
int tiled(double n, int count, Tiling tiling) {
  const double size = count;
  switch (tiling) {
    case Tiling::edge: return static_cast<int>(std::clamp(n, 0.0, size - 1.0));
    case Tiling::repeat:
      return static_cast<int>(std::clamp(n - size * std::floor(n / size), 0.0, size - 1.0));
    case Tiling::mirror: {
      const double period = 2.0 * size;
      const double m = std::clamp(n - period * std::floor(n / period), 0.0, period - 1.0);
      return static_cast<int>(m < size ? m : period - 1.0 - m);
    }
  }
  return 0;
}

struct InCells {
  double column = 0.0, row = 0.0;
};

InCells in_cells(const MapGrid& grid, const MapPosition& position) {
  const bool by_position = grid.by == MapBy::position;
  return {((by_position ? position.x_m : position.u) - grid.west_m) / grid.cell_width_m,
          (grid.north_m - (by_position ? position.y_m : position.v)) / grid.cell_height_m};
}

}  // namespace

std::size_t MapGrid::cell_at(const MapPosition& position) const {
  const InCells at = in_cells(*this, position);
  return static_cast<std::size_t>(tiled(std::floor(at.row), height, tiling_down.value_or(tiling))) *
             static_cast<std::size_t>(width) +
         static_cast<std::size_t>(tiled(std::floor(at.column), width, tiling));
}

MapGrid::Corners MapGrid::corners_at(const MapPosition& position) const {
  const InCells at = in_cells(*this, position);
  const double column = std::floor(at.column - 0.5), row = std::floor(at.row - 0.5);
  const double across = at.column - 0.5 - column, down = at.row - 0.5 - row;
  Corners corners{};
  for (int k = 0; k < 4; ++k) {
    const int east = k % 2, south = k / 2;
    corners.cell[k] = static_cast<std::size_t>(tiled(row + south, height, tiling_down.value_or(tiling))) *
                          static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(tiled(column + east, width, tiling));
    corners.share[k] = (east != 0 ? across : 1.0 - across) * (south != 0 ? down : 1.0 - down);
  }
  return corners;
}

void check(const MapGrid& grid, std::size_t value_count, const std::string& what) {
  if (grid.width < 1 || grid.height < 1 || !(grid.cell_width_m > 0.0) || !(grid.cell_height_m > 0.0))
    throw InputError(format("{} needs cells of some size: found {} x {} cells of {:g} m x {:g} m", what,
                            grid.width, grid.height, grid.cell_width_m, grid.cell_height_m));
  if (value_count != grid.cell_count())
    throw InputError(format("{} of {} x {} cells needs {} values: found {}", what, grid.width, grid.height,
                            grid.cell_count(), value_count));
}

}  // namespace ifov::materials
