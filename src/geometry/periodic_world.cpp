#include "geometry/periodic_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"

namespace ifov::geometry {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Parts of a ray in neighbouring cells overlap by so much, relative to the distances involved, lest something in
/// the border itself be missed from both.
constexpr double kOverlap = 1e-10;

/// Cells beyond its own that an object may reach into.
constexpr int kFurthest = 8;

}  // namespace

PeriodicWorld::PeriodicWorld(std::unique_ptr<World> world, Cell cell)
    : world_(std::move(world)), cell_(cell) {
  if (!(cell.width_m > 0.0) || !(cell.height_m > 0.0) || !std::isfinite(cell.width_m) ||
      !std::isfinite(cell.height_m))
    throw InputError(
        format("a scene repeats every {} m x {} m; expected positive lengths", cell.width_m, cell.height_m));
  bool bounded = false;
  for (std::size_t k = 0; !bounded && k < world_->object_count(); ++k)
    bounded = std::isfinite(world_->object(k).radius_m);
  const Heights heights = world_->heights();
  low_z_m_ = heights.low_m, high_z_m_ = heights.high_m;
  if (bounded) {
    const Bounds b = world_->bounds();
    const auto reach = [](double first, double length, double low, double high, int& from, int& to) {
      constexpr double kSlack = 1e-9;
      from = static_cast<int>(std::floor((first - high) / length + kSlack)) + 1;
      to = static_cast<int>(std::ceil((first + length - low) / length - kSlack)) - 1;
    };
    if (std::max({cell.west_m - b.low_m.x, b.high_m.x - cell.west_m - cell.width_m, 0.0}) >
            kFurthest * cell.width_m ||
        std::max({cell.south_m - b.low_m.y, b.high_m.y - cell.south_m - cell.height_m, 0.0}) >
            kFurthest * cell.height_m)
      throw InputError(
          format("a scene that repeats every {:g} m x {:g} m holds something that reaches more than {} "
                 "times as far beyond that cell (x {:g} to {:g} m, y {:g} to {:g} m)",
                 cell.width_m, cell.height_m, kFurthest, b.low_m.x, b.high_m.x, b.low_m.y, b.high_m.y));
    reach(cell.west_m, cell.width_m, b.low_m.x, b.high_m.x, first_column_, last_column_);
    reach(cell.south_m, cell.height_m, b.low_m.y, b.high_m.y, first_row_, last_row_);
  }
  const double padding = 1e-6 * (1.0 + std::max(std::abs(low_z_m_), std::abs(high_z_m_)));
  low_z_m_ -= padding, high_z_m_ += padding;
}

bool PeriodicWorld::start(const math::Ray& ray, std::uint32_t index, Walk& walk) const {
  const math::Vec3 d = ray.direction;
  double first = ray.t_min_m, last = ray.t_max_m;
  const double z = ray.origin_m.z;
  if (d.z == 0.0) {
    if (z < low_z_m_ || z > high_z_m_) return false;
  } else {
    const double a = (low_z_m_ - z) / d.z, b = (high_z_m_ - z) / d.z;
    first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
  }
  if (!(first <= last)) return false;
  walk = {};
  walk.ray = index;
  walk.begin_m = first, walk.last_m = last;
  walk.column = static_cast<int>(std::floor((ray.origin_m.x + first * d.x - cell_.west_m) / cell_.width_m));
  walk.row = static_cast<int>(std::floor((ray.origin_m.y + first * d.y - cell_.south_m) / cell_.height_m));
  walk.step_x = (d.x > 0.0) - (d.x < 0.0), walk.step_y = (d.y > 0.0) - (d.y < 0.0);
  set_end(ray, walk);
  return true;
}

void PeriodicWorld::set_end(const math::Ray& ray, Walk& walk) const {
  const auto border = [](int cell, int step, double first, double length, double from, double direction) {
    return step == 0 ? kInfinity : (first + (cell + (step > 0)) * length - from) / direction;
  };
  walk.end_m = std::min(
      {walk.last_m,
       border(walk.column, walk.step_x, cell_.west_m, cell_.width_m, ray.origin_m.x, ray.direction.x),
       border(walk.row, walk.step_y, cell_.south_m, cell_.height_m, ray.origin_m.y, ray.direction.y)});
}

bool PeriodicWorld::advance(const math::Ray& ray, Walk& walk) const {
  if (!(walk.end_m < walk.last_m) || ++walk.cells >= kMostCells) return false;
  const double x = (cell_.west_m + (walk.column + (walk.step_x > 0)) * cell_.width_m - ray.origin_m.x);
  const double y = (cell_.south_m + (walk.row + (walk.step_y > 0)) * cell_.height_m - ray.origin_m.y);
  const double to_x = walk.step_x == 0 ? kInfinity : x / ray.direction.x;
  const double to_y = walk.step_y == 0 ? kInfinity : y / ray.direction.y;
  walk.begin_m = std::max(walk.begin_m, walk.end_m);
  if (to_x <= to_y) walk.column += walk.step_x;
  if (to_y <= to_x) walk.row += walk.step_y;
  set_end(ray, walk);
  return true;
}

template <class Query>
void PeriodicWorld::each_copy(std::span<const math::Ray> rays, std::span<const Walk> walks,
                              Query query) const {
  std::vector<math::Ray> moved(walks.size());
  for (int column = first_column_; column <= last_column_; ++column)
    for (int row = first_row_; row <= last_row_; ++row) {
      for (std::size_t k = 0; k < walks.size(); ++k) {
        const Walk& walk = walks[k];
        math::Ray& ray = moved[k];
        ray = rays[walk.ray];
        ray.origin_m = ray.origin_m - math::Vec3{(walk.column + column) * cell_.width_m,
                                                 (walk.row + row) * cell_.height_m, 0.0};
        const double overlap = kOverlap * (cell_.width_m + cell_.height_m + std::abs(walk.end_m));
        ray.t_min_m = std::max(ray.t_min_m, walk.begin_m - overlap);
        ray.t_max_m = std::min(ray.t_max_m, walk.end_m + overlap);
      }
      query(std::span<const math::Ray>(moved), column, row);
    }
}

void PeriodicWorld::intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const {
  intersect(rays, hits, &World::intersect);
}

void PeriodicWorld::intersect_uncut(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const {
  intersect(rays, hits, &World::intersect_uncut);
}

void PeriodicWorld::intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits,
                              Meet meet) const {
  std::vector<Walk> walks;
  for (std::uint32_t k = 0; k < rays.size(); ++k) {
    hits[k] = SurfacePoint{};
    Walk walk;
    if (start(rays[k], k, walk)) walks.push_back(walk);
  }
  std::vector<SurfacePoint> found;
  while (!walks.empty()) {
    found.resize(walks.size());
    each_copy(rays, walks, [&](std::span<const math::Ray> moved, int column, int row) {
      ((*world_).*meet)(moved, found);
      for (std::size_t k = 0; k < walks.size(); ++k) {
        SurfacePoint& best = hits[walks[k].ray];
        if (!found[k].hit() || (best.hit() && !(found[k].distance_m < best.distance_m))) continue;
        best = found[k];
        best.copy_column = walks[k].column + column;
        best.copy_row = walks[k].row + row;
        best.position_m = best.position_m +
                          math::Vec3{best.copy_column * cell_.width_m, best.copy_row * cell_.height_m, 0.0};
      }
    });
    std::erase_if(walks, [&](Walk& walk) { return hits[walk.ray].hit() || !advance(rays[walk.ray], walk); });
  }
}

void PeriodicWorld::occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const {
  std::vector<Walk> walks;
  for (std::uint32_t k = 0; k < rays.size(); ++k) {
    blocked[k] = 0;
    Walk walk;
    if (start(rays[k], k, walk)) walks.push_back(walk);
  }
  std::vector<std::uint8_t> found;
  while (!walks.empty()) {
    found.resize(walks.size());
    each_copy(rays, walks, [&](std::span<const math::Ray> moved, int, int) {
      world_->occluded(moved, found);
      for (std::size_t k = 0; k < walks.size(); ++k) blocked[walks[k].ray] |= found[k];
    });
    std::erase_if(walks,
                  [&](Walk& walk) { return blocked[walk.ray] != 0 || !advance(rays[walk.ray], walk); });
  }
}

}  // namespace ifov::geometry
