#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace ifov::materials {

/// What lies beyond the edges of a map.
enum class Tiling {
  edge,    ///< the nearest cell goes on
  repeat,  ///< the map again
  mirror,  ///< the map again, every other copy reversed, so that copies meet in like cells
};

/// Which coordinates of a surface point a map is looked up at.
enum class MapBy {
  position,             ///< x and y in the scene: draped from above
  texture_coordinates,  ///< u and v of the surface; v rises towards the first row
};

/// The coordinates of a surface point that maps use.
struct MapPosition {
  double x_m = 0.0, y_m = 0.0;  ///< in the scene
  double u = 0.0, v = 0.0;      ///< texture coordinates
};

/// Where a raster lies on a surface: square or oblong cells, rows from north (large y, large v) to south. Lengths are
/// metres, or for texture coordinates their units. A cell holds its west and north edges.
struct MapGrid {
  double west_m = 0.0;   ///< x of the left edge
  double north_m = 0.0;  ///< y of the upper edge
  double cell_width_m = 1.0, cell_height_m = 1.0;
  int width = 0, height = 0;
  Tiling tiling = Tiling::edge;
  MapBy by = MapBy::position;
  std::optional<Tiling> tiling_down = std::nullopt;  ///< of rows, where it is another than of columns

  /// Index of the cell that holds a place.
  std::size_t cell_at(const MapPosition& position) const;

  /// The four cells whose middles surround a place, and the shares of bilinear interpolation.
  struct Corners {
    std::size_t cell[4];  ///< north-west, north-east, south-west, south-east
    double share[4];
  };
  Corners corners_at(const MapPosition& position) const;

  std::size_t cell_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Throws InputError unless cells have a size and there are as many of them as values; `what` names the map.
void check(const MapGrid& grid, std::size_t value_count, const std::string& what);

}  // namespace ifov::materials
