#include "render/mapped/map_window.h"

#include <algorithm>
#include <cmath>

#include "geometry/world.h"
#include "sampling/accuracy/borders/polygon.h"

namespace ifov::render {

namespace {

MapCell minus(MapCell p, MapCell q) { return {p.a - q.a, p.b - q.b}; }
MapCell plus(MapCell p, MapCell q) { return {p.a + q.a, p.b + q.b}; }

}  // namespace

MapCell cell_of(const materials::MapGrid& grid, const geometry::SurfacePoint& at,
                const geometry::World& world) {
  double x = at.u, y = at.v;
  if (grid.by == materials::MapBy::position) {
    x = at.position_m.x, y = at.position_m.y;
    if (const auto period = world.period()) x -= at.copy_column * period->x_m, y -= at.copy_row * period->y_m;
  }
  return {(x - grid.west_m) / grid.cell_width_m, (grid.north_m - y) / grid.cell_height_m};
}

materials::MapPosition position_of(const materials::MapGrid& grid, double a, double b) {
  const double x = grid.west_m + a * grid.cell_width_m, y = grid.north_m - b * grid.cell_height_m;
  return {x, y, x, y};
}

std::optional<std::size_t> corner_of_most(std::span<const geometry::SurfacePoint> corners) {
  for (std::size_t k = 0; k < 2; ++k) {
    const auto same = [&](const geometry::SurfacePoint& p) {
      return p.hit() && p.material == corners[k].material && p.instance == corners[k].instance &&
             p.copy_column == corners[k].copy_column && p.copy_row == corners[k].copy_row;
    };
    if (corners[k].hit() && std::count_if(corners.begin(), corners.end(), same) >= 3) return k;
  }
  return std::nullopt;
}

std::optional<MapWindow> MapWindow::over(std::span<const geometry::SurfacePoint> corners, std::size_t first,
                                         const materials::MapGrid& grid, const geometry::World& world) {
  std::array<MapCell, 4> at;
  std::array<bool, 4> seen{};
  for (std::size_t k = 0; k < 4; ++k) {
    seen[k] = corners[k].hit() && corners[k].material == corners[first].material &&
              corners[k].instance == corners[first].instance;
    if (seen[k]) at[k] = cell_of(grid, corners[k], world);
  }
  MapWindow window;
  window.per_x = seen[0] && seen[1] ? minus(at[1], at[0]) : minus(at[3], at[2]);
  window.per_y = seen[0] && seen[2] ? minus(at[2], at[0]) : minus(at[3], at[1]);
  window.at = seen[0] ? at[0] : minus(minus(at[3], window.per_x), window.per_y);
  if (!(std::abs(window.determinant()) > 0.0) || !std::isfinite(window.determinant())) return std::nullopt;
  return window;
}

sampling::FocalPoint MapWindow::reach(double step) const {
  const double d = std::abs(determinant());
  return {0.5 * step * (std::abs(per_y.b) + std::abs(per_y.a)) / d,
          0.5 * step * (std::abs(per_x.a) + std::abs(per_x.b)) / d};
}

MapWindow::Bounds MapWindow::bounds() const {
  MapCell low = at, high = at;
  for (const MapCell p : {plus(at, per_x), plus(at, per_y), plus(plus(at, per_x), per_y)}) {
    low = {std::min(low.a, p.a), std::min(low.b, p.b)};
    high = {std::max(high.a, p.a), std::max(high.b, p.b)};
  }
  return {{std::floor(low.a), std::floor(low.b)}, {std::ceil(high.a), std::ceil(high.b)}};
}

MapWindow::Seen MapWindow::seen(double a, double b) const {
  sampling::Polygon cell;
  for (const MapCell p : {MapCell{-0.5, -0.5}, MapCell{0.5, -0.5}, MapCell{0.5, 0.5}, MapCell{-0.5, 0.5}}) {
    const sampling::FocalPoint corner = offset(a + p.a, b + p.b);
    cell.add({corner.x_px, corner.y_px});
  }
  const sampling::Polygon inside = cell.clipped(-1, 0, 0).clipped(1, 0, 1).clipped(0, -1, 0).clipped(0, 1, 1);
  Seen part;
  if (inside.count < 3) return part;
  part.area = std::abs(inside.signed_area());
  for (int i = 0; i < inside.count; ++i) {
    part.middle.x_px += inside.vertex[i].x / inside.count;
    part.middle.y_px += inside.vertex[i].y / inside.count;
  }
  return part;
}

}  // namespace ifov::render
