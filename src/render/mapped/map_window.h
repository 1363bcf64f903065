#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "geometry/surface_point.h"
#include "materials/map_grid.h"
#include "sampling/field.h"

namespace ifov::geometry {
class World;
}

namespace ifov::render {

struct MapCell {
  double a = 0.0, b = 0.0;  ///< in cells: to the right and down
};

/// Map coordinates over a pixel, linear in the offset from its corner: what a pixel sees of one surface is nearly flat.
struct MapWindow {
  MapCell at, per_x, per_y;

  /// From what the pixel's corners show, row by row: at least three of them the surface of corner `first`. None where these do not
  /// tell how the map lies.
  static std::optional<MapWindow> over(std::span<const geometry::SurfacePoint> corners, std::size_t first,
                                       const materials::MapGrid& grid, const geometry::World& world);

  double determinant() const { return per_x.a * per_y.b - per_x.b * per_y.a; }
  sampling::FocalPoint offset(double a, double b) const {
    const double da = a - at.a, db = b - at.b, d = determinant();
    return {(da * per_y.b - db * per_y.a) / d, (per_x.a * db - per_x.b * da) / d};
  }
  /// Half a cell of `step` map cells a side, px: a cell whose middle is farther outside does not reach into the pixel.
  sampling::FocalPoint reach(double step) const;

  struct Bounds {
    MapCell low, high;
  };
  /// Whole cells that hold the pixel.
  Bounds bounds() const;

  /// What the pixel sees of the cell about (a, b), which may be much longer than the pixel: its area, px^2, and its middle.
  struct Seen {
    double area = 0.0;
    sampling::FocalPoint middle;
  };
  Seen seen(double a, double b) const;
};

/// The first of a pixel's corners whose surface three or four of them show; none: there is no such.
std::optional<std::size_t> corner_of_most(std::span<const geometry::SurfacePoint> corners);

/// Where a map is looked up at a place, in cells; of a copy of a periodic scene, that of the cell that is repeated.
MapCell cell_of(const materials::MapGrid& grid, const geometry::SurfacePoint& at,
                const geometry::World& world);
materials::MapPosition position_of(const materials::MapGrid& grid, double a, double b);

}  // namespace ifov::render
