#include "render/mirrors/image_spectra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sampling/random.h"

namespace ifov::render {

namespace {

using Light = FocalLights::Light;

/// Along a side, for points that count as one: a footprint hardly changes over so small a part of a pixel.
constexpr double kCellsPerPixel = 8.0;

std::vector<Light> together(const std::vector<Light>& points) {
  struct Cell {
    double area = 0.0, x = 0.0, y = 0.0;
  };
  std::map<std::pair<int, int>, Cell> cells;
  const auto cell = [](double at) { return static_cast<int>(std::floor(kCellsPerPixel * at)); };
  for (const Light& point : points) {
    const auto area = static_cast<double>(point.per_radiance);
    Cell& sum = cells[{cell(point.at.x_px), cell(point.at.y_px)}];
    sum.area += area, sum.x += area * point.at.x_px, sum.y += area * point.at.y_px;
  }
  std::vector<Light> lights;
  for (const auto& [name, sum] : cells)
    lights.push_back(
        {{sum.x / sum.area, sum.y / sum.area}, static_cast<float>(sum.area), 0, points.front().replicate});
  return lights;
}

/// Evenly among the points in their order.
std::vector<Light> some(const std::vector<Light>& points, std::uint64_t key) {
  if (points.size() <= ImageSpectrum::kPaths) return points;
  std::vector<Light> chosen;
  const double step = static_cast<double>(points.size()) / ImageSpectrum::kPaths;
  for (std::size_t k = 0; k < ImageSpectrum::kPaths; ++k) {
    const double position = (static_cast<double>(k) + sampling::unit_double(sampling::hash(key, k))) * step;
    chosen.push_back(points[std::min(static_cast<std::size_t>(position), points.size() - 1)]);
  }
  return chosen;
}

}  // namespace

std::vector<ImageSpectrum> image_spectra(std::span<const Light> seen, std::uint64_t key) {
  std::map<std::array<int, 3>, std::vector<Light>> by_pixel;
  for (const Light& point : seen)
    by_pixel[{static_cast<int>(std::floor(point.at.x_px)), static_cast<int>(std::floor(point.at.y_px)),
              static_cast<int>(point.replicate)}]
        .push_back(point);
  std::vector<ImageSpectrum> rows;
  for (const auto& [name, points] : by_pixel)
    rows.push_back({some(points, sampling::hash(key, rows.size())), together(points)});
  return rows;
}

}  // namespace ifov::render
