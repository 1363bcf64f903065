#include "render/mapped/map_detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/world.h"
#include "materials/draped_map.h"
#include "render/mapped/map_window.h"
#include "sampling/known_detail.h"
#include "scene/cut_out.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::render {

namespace {

constexpr std::uint16_t kOutside = 0xffff;
/// "Class" of the holes of a surface: what is seen through them is another thing.
constexpr std::uint16_t kHole = 0xfffe;
/// A pixel that holds more parts than this is full of detail.
constexpr std::size_t kMostParts = 24;
/// So is one with more specks than this, parts smaller than what a lattice sees.
constexpr std::size_t kMostSpecks = 3;
constexpr double kSpeck_px = 1.0 / 3.0;
/// So is one with a part whose border is longer than this: a net, of which one place tells little. (A strip across a
/// pixel has 2 to 3, a disc in steps hardly more.)
constexpr double kLongestBorder_px = 4.0;
/// Cells of a map are looked at one by one while a pixel holds no more of them than this, else a raster of so many.
constexpr double kMostCells = 4096.0;
/// Of a cell so much of which lies in the pixel the middle of that is as good as any other's.
constexpr double kMuch = 0.5;

}  // namespace

MapDetail::MapDetail(const scene::Scene& scene, const sensor::Camera& camera)
    : scene_(scene), camera_(camera), standouts_(scene, camera) {
  any_ =
      std::any_of(scene.assignments.begin(), scene.assignments.end(), [](const scene::SurfaceAssignment& c) {
        return (c.classes != nullptr && c.states.size() > 1) || c.cut_out != nullptr;
      });
}

void MapDetail::find(const sampling::FieldRect& pixels, sampling::KnownDetail& detail, std::uint64_t& rays) {
  const std::size_t width = static_cast<std::size_t>(pixels.x1 - pixels.x0);
  const std::size_t height = static_cast<std::size_t>(pixels.y1 - pixels.y0);
  detail.points.clear();
  detail.standouts.clear();
  detail.full.assign(width * height, 0);
  if (!any_ && !standouts_.any()) return;
  std::vector<sampling::FocalPoint> points((width + 1) * (height + 1));
  for (std::size_t j = 0; j <= height; ++j)
    for (std::size_t i = 0; i <= width; ++i)
      points[j * (width + 1) + i] = {pixels.x0 + static_cast<double>(i), pixels.y0 + static_cast<double>(j)};
  std::vector<math::Ray> corner_rays(points.size());
  std::vector<geometry::SurfacePoint> hits(points.size());
  camera_.rays(points, corner_rays);
  // Holes are looked for where they are, not what lies behind them.
  scene_.world->intersect_uncut(corner_rays, hits);
  rays += points.size();
  for (std::size_t j = 0; j < height; ++j)
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t c = j * (width + 1) + i;
      const std::array<geometry::SurfacePoint, 4> corners{hits[c], hits[c + 1], hits[c + width + 1],
                                                          hits[c + width + 2]};
      if (any_) find_in_pixel(corners, j * width + i, points[c], detail);
      standouts_.find_in_pixel(corners, points[c], detail.standouts, rays);
    }
}

void MapDetail::find_in_pixel(std::span<const geometry::SurfacePoint> corners, std::size_t pixel,
                              sampling::FocalPoint origin, sampling::KnownDetail& detail) {
  // The map of the surface that most corners see; three of them tell how it lies.
  const std::optional<std::size_t> first = corner_of_most(corners);
  if (!first) return;
  const scene::SurfaceAssignment& assignment = scene_.assignments[corners[*first].material];
  if (assignment.classes == nullptr && assignment.cut_out == nullptr) return;
  const materials::MapGrid& grid =
      assignment.cut_out != nullptr ? assignment.cut_out->grid() : assignment.classes->grid();
  const auto class_at = [&](const materials::MapPosition& position) {
    if (assignment.cut_out != nullptr && assignment.cut_out->is_open(position)) return kHole;
    return assignment.classes != nullptr ? assignment.classes->at(position) : std::uint16_t{0};
  };
  const auto alike_in_label = [&](std::uint16_t a, std::uint16_t b) {
    return a == kHole || b == kHole ? a == b : assignment.states[a] == assignment.states[b];
  };
  const std::optional<MapWindow> over = MapWindow::over(corners, *first, grid, *scene_.world);
  if (!over) return;
  const MapWindow& window = *over;
  const auto [low, high] = window.bounds();
  const double cells = (high.a - low.a) * (high.b - low.b);
  if (cells <= 1.0) return;
  const double step = cells <= kMostCells ? 1.0 : std::sqrt(cells / kMostCells);
  const auto columns = static_cast<std::size_t>(std::ceil((high.a - low.a) / step));
  const auto rows = static_cast<std::size_t>(std::ceil((high.b - low.b) / step));

  const double d = std::abs(window.determinant());
  const sampling::FocalPoint reach = window.reach(step);
  classes_.assign(columns * rows, kOutside);
  std::uint16_t any_class = kOutside;
  bool mixed = false;
  const auto position_in_map = [&](std::size_t cell) {
    return MapCell{low.a + (static_cast<double>(cell % columns) + 0.5) * step,
                   low.b + (static_cast<double>(cell / columns) + 0.5) * step};
  };
  for (std::size_t cell = 0; cell < classes_.size(); ++cell) {
    const MapCell position = position_in_map(cell);
    const sampling::FocalPoint o = window.offset(position.a, position.b);
    if (o.x_px <= -reach.x_px || o.x_px >= 1.0 + reach.x_px || o.y_px <= -reach.y_px ||
        o.y_px >= 1.0 + reach.y_px)
      continue;
    const std::uint16_t number = class_at(position_of(grid, position.a, position.b));
    classes_[cell] = number;
    mixed = mixed || (any_class != kOutside && !alike_in_label(number, any_class));
    any_class = number;
  }
  if (!mixed) return;
  if (step > 1.0) {
    detail.full[pixel] = 1;
    return;
  }

  // Parts of one class that hang together; each is looked at once, in its middle.
  const std::size_t points_before = detail.points.size();
  const std::vector<std::uint16_t> known = classes_;
  std::size_t specks = 0;
  const double side_along_a_px = std::hypot(window.per_y.b, window.per_x.b) / d,
               side_along_b_px = std::hypot(window.per_y.a, window.per_x.a) / d;
  const auto fill_pixel = [&] {
    detail.points.resize(points_before);
    detail.full[pixel] = 1;
  };
  for (std::size_t start = 0; start < classes_.size(); ++start) {
    const std::uint16_t number = classes_[start];
    if (number == kOutside) continue;
    part_.clear();
    double border_px = 0.0;
    std::size_t left = start % columns, right = left, lowest = start / columns;
    queue_.assign(1, static_cast<std::uint32_t>(start));
    classes_[start] = kOutside;
    while (!queue_.empty()) {
      const std::uint32_t cell = queue_.back();
      queue_.pop_back();
      part_.push_back(cell);
      const auto visit = [&](std::size_t next, double side_px) {
        // Of a side that is longer than the pixel, the pixel sees no more than its own diagonal.
        if (known[next] != number && known[next] != kOutside)
          border_px += std::min(side_px, std::numbers::sqrt2);
        if (classes_[next] != number) return;
        classes_[next] = kOutside;
        queue_.push_back(static_cast<std::uint32_t>(next));
      };
      const std::size_t column = cell % columns, row = cell / columns;
      left = std::min(left, column), right = std::max(right, column), lowest = std::max(lowest, row);
      if (column > 0) visit(cell - 1, side_along_b_px);
      if (column + 1 < columns) visit(cell + 1, side_along_b_px);
      if (row > 0) visit(cell - columns, side_along_a_px);
      if (row + 1 < rows) visit(cell + columns, side_along_a_px);
    }
    // The middle one of its cells, or the one that the pixel sees most of.
    std::nth_element(part_.begin(), part_.begin() + static_cast<std::ptrdiff_t>(part_.size() / 2),
                     part_.end());
    std::swap(part_.front(), part_[part_.size() / 2]);
    MapWindow::Seen most;
    for (std::size_t k = 0; k < part_.size() && most.area < kMuch / d; ++k) {
      const MapCell position = position_in_map(part_[k]);
      const MapWindow::Seen part = window.seen(position.a, position.b);
      if (part.area > most.area) most = part;
    }
    if (most.area == 0.0) continue;
    const auto across = static_cast<double>(right - left + 1),
               down = static_cast<double>(lowest - start / columns + 1);
    if (across * side_along_a_px < kSpeck_px && down * side_along_b_px < kSpeck_px) ++specks;
    if (specks > kMostSpecks || detail.points.size() - points_before == kMostParts ||
        border_px > kLongestBorder_px)
      return fill_pixel();
    detail.points.push_back({origin.x_px + most.middle.x_px, origin.y_px + most.middle.y_px});
  }
}

}  // namespace ifov::render
