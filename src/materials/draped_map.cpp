#include "materials/draped_map.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::materials {
namespace {

void check(const MapGrid& grid, std::size_t count) {
  if (grid.width < 1 || grid.height < 1 || !(grid.cell_width_m > 0.0) || !(grid.cell_height_m > 0.0))
    throw InputError(format("a map needs cells of some size: found {} x {} cells of {:g} m x {:g} m",
                            grid.width, grid.height, grid.cell_width_m, grid.cell_height_m));
  const std::size_t expected = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  if (count != expected)
    throw InputError(
        format("a map of {} x {} cells needs {} values: found {}", grid.width, grid.height, expected, count));
}

/// Cell index of a position in cells, clamped while still a double (an int may not hold it).
int cell(double position, int count) {
  return static_cast<int>(std::clamp(std::floor(position), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

ClassMap::ClassMap(MapGrid grid, std::vector<std::uint16_t> classes)
    : grid_(grid), classes_(std::move(classes)) {
  check(grid_, classes_.size());
}

std::uint16_t ClassMap::at(double x_m, double y_m) const {
  const int column = cell((x_m - grid_.west_m) / grid_.cell_width_m, grid_.width);
  const int row = cell((grid_.north_m - y_m) / grid_.cell_height_m, grid_.height);
  return classes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.width) +
                  static_cast<std::size_t>(column)];
}

std::uint16_t ClassMap::largest_class() const { return *std::max_element(classes_.begin(), classes_.end()); }

TemperatureMap::TemperatureMap(MapGrid grid, std::vector<float> temperature_k)
    : grid_(grid), temperature_k_(std::move(temperature_k)) {
  check(grid_, temperature_k_.size());
  for (const float value : temperature_k_)
    if (!(value > 0.0f) || !std::isfinite(value))
      throw InputError(format("a temperature map holds {:g} K; temperatures must be above 0 K", value));
}

double TemperatureMap::at_k(double x_m, double y_m) const {
  const double x = std::clamp((x_m - grid_.west_m) / grid_.cell_width_m - 0.5, 0.0, grid_.width - 1.0);
  const double y = std::clamp((grid_.north_m - y_m) / grid_.cell_height_m - 0.5, 0.0, grid_.height - 1.0);
  const int column = cell(x, grid_.width), row = cell(y, grid_.height);
  const int right = std::min(column + 1, grid_.width - 1), below = std::min(row + 1, grid_.height - 1);
  const double across = x - column, down = y - row;
  const auto value = [&](int r, int c) {
    return static_cast<double>(
        temperature_k_[static_cast<std::size_t>(r) * static_cast<std::size_t>(grid_.width) +
                       static_cast<std::size_t>(c)]);
  };
  const double upper = value(row, column) + across * (value(row, right) - value(row, column));
  const double lower = value(below, column) + across * (value(below, right) - value(below, column));
  return upper + down * (lower - upper);
}

double TemperatureMap::minimum_k() const {
  return *std::min_element(temperature_k_.begin(), temperature_k_.end());
}
double TemperatureMap::maximum_k() const {
  return *std::max_element(temperature_k_.begin(), temperature_k_.end());
}

}  // namespace ifov::materials
