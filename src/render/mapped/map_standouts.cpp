#include "render/mapped/map_standouts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/world.h"
#include "materials/numbered_map.h"
#include "math/ray.h"
#include "render/mapped/map_window.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::render {

namespace {

bool same_surface(const geometry::SurfacePoint& a, const geometry::SurfacePoint& b) {
  return a.hit() && b.hit() && a.material == b.material && a.instance == b.instance &&
         a.copy_column == b.copy_column && a.copy_row == b.copy_row;
}

/// The lowest and the highest number of `map` among cells whose middles are in the pixel, and among those that lie about it within one
/// cell, which a map that is bilinear between middles shows on its rim: the points of the pixel nearest to them.
void add_extremes(const materials::NumberedMap& map, const MapWindow& window, sampling::FocalPoint origin,
                  std::vector<sampling::FocalPoint>& points) {
  const auto [low, high] = window.bounds();
  float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
  for (int k = 0; k < 4; ++k) {
    const double x = k % 2, y = k / 2;
    const double a = window.at.a + x * window.per_x.a + y * window.per_y.a,
                 b = window.at.b + x * window.per_x.b + y * window.per_y.b;
    // A map may be bilinear between middles: a corner on the rim of a cell shows something between four.
    float least = std::numeric_limits<float>::infinity(), most = -least;
    for (int near = 0; near < 4; ++near) {
      const float number = map.number(map.grid().cell_at(
          position_of(map.grid(), a + (near % 2 == 0 ? -0.5 : 0.5), b + (near / 2 == 0 ? -0.5 : 0.5))));
      least = std::min(least, number);
      most = std::max(most, number);
    }
    lowest = std::min(lowest, most);
    highest = std::max(highest, least);
  }
  const auto add = [&](const materials::NumberedMap::Place& place) {
    constexpr double kWithin = 1e-6;  // of a pixel: its own edges are in it
    const sampling::FocalPoint o = window.offset(place.column, place.row);
    points.push_back({origin.x_px + std::clamp(o.x_px, kWithin, 1.0 - kWithin),
                      origin.y_px + std::clamp(o.y_px, kWithin, 1.0 - kWithin)});
  };
  const sampling::FocalPoint reach = window.reach(2.0);
  for (const bool about : {false, true}) {
    const auto inside = [&](double a, double b) {
      const sampling::FocalPoint o = window.offset(a, b);
      const bool within = o.x_px >= 0.0 && o.x_px < 1.0 && o.y_px >= 0.0 && o.y_px < 1.0;
      return about ? !within && o.x_px > -reach.x_px && o.x_px < 1.0 + reach.x_px && o.y_px > -reach.y_px &&
                         o.y_px < 1.0 + reach.y_px
                   : within;
    };
    const materials::NumberedMap::Extremes found =
        map.extremes(low.a - 1.0, low.b - 1.0, high.a + 1.0, high.b + 1.0, inside);
    if (!found.any) continue;
    if (found.lowest.number < lowest) add(found.lowest);
    if (found.highest.number > highest) add(found.highest);
  }
}

}  // namespace

MapStandouts::MapStandouts(const scene::Scene& scene, const sensor::Camera& camera)
    : scene_(scene), camera_(camera) {
  for (const scene::SurfaceAssignment& assignment : scene.assignments) {
    maps_.push_back(assignment.maps());
    any_ = any_ || !maps_.back().empty();
  }
}

/// How the map lies about corner `k`, by two more rays near it.
std::optional<MapWindow> MapStandouts::window_about(const geometry::SurfacePoint& corner, std::size_t k,
                                                    sampling::FocalPoint origin,
                                                    const materials::MapGrid& grid) const {
  constexpr double kApart_px = 0.01;
  const double x = static_cast<double>(k % 2), y = static_cast<double>(k / 2);
  const std::array<sampling::FocalPoint, 2> near{
      {{origin.x_px + x + (x > 0.0 ? -kApart_px : kApart_px), origin.y_px + y},
       {origin.x_px + x, origin.y_px + y + (y > 0.0 ? -kApart_px : kApart_px)}}};
  std::array<math::Ray, 2> rays;
  std::array<geometry::SurfacePoint, 2> hits;
  camera_.rays(near, rays);
  scene_.world->intersect_uncut(rays, hits);
  if (!same_surface(corner, hits[0]) || !same_surface(corner, hits[1])) return std::nullopt;
  // Towards the pixel's inside at either side of it: four corners of one plane, as they would be seen.
  const geometry::World& world = *scene_.world;
  const MapCell at = cell_of(grid, corner, world), right = cell_of(grid, hits[0], world),
                below = cell_of(grid, hits[1], world);
  const double step_x = x > 0.0 ? -kApart_px : kApart_px, step_y = y > 0.0 ? -kApart_px : kApart_px;
  MapWindow window;
  window.per_x = {(right.a - at.a) / step_x, (right.b - at.b) / step_x};
  window.per_y = {(below.a - at.a) / step_y, (below.b - at.b) / step_y};
  window.at = {at.a - x * window.per_x.a - y * window.per_y.a,
               at.b - x * window.per_x.b - y * window.per_y.b};
  if (!(std::abs(window.determinant()) > 0.0) || !std::isfinite(window.determinant())) return std::nullopt;
  return window;
}

void MapStandouts::find_in_pixel(std::span<const geometry::SurfacePoint> corners, sampling::FocalPoint origin,
                                 std::vector<sampling::FocalPoint>& points, std::uint64_t& rays) const {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto same = [&](const geometry::SurfacePoint& other) { return same_surface(corners[k], other); };
    if (!corners[k].hit() ||
        std::any_of(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k), same))
      continue;
    const bool most = std::count_if(corners.begin(), corners.end(), same) >= 3;
    for (const materials::NumberedMap* map : maps_[corners[k].material]) {
      if (!most) rays += 2;
      const std::optional<MapWindow> window = most ? MapWindow::over(corners, k, map->grid(), *scene_.world)
                                                   : window_about(corners[k], k, origin, map->grid());
      if (window) add_extremes(*map, *window, origin, points);
    }
  }
}

}  // namespace ifov::render
