#include "materials/draped_map.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::materials {

ClassMap::ClassMap(MapGrid grid, std::vector<std::uint16_t> classes)
    : NumberedMap(grid), classes_(std::move(classes)) {
  check(grid_, classes_.size(), "a map");
  find_blocks();
}

std::uint16_t ClassMap::largest_class() const { return *std::max_element(classes_.begin(), classes_.end()); }

TemperatureMap::TemperatureMap(MapGrid grid, std::vector<float> temperature_k)
    : NumberedMap(grid), temperature_k_(std::move(temperature_k)) {
  check(grid_, temperature_k_.size(), "a map");
  for (std::size_t k = 0; k < temperature_k_.size(); ++k) {
    const float value = temperature_k_[k];
    if (value > 0.0f && value <= static_cast<float>(kHottest_k)) continue;
    const auto width = static_cast<std::size_t>(grid_.width);
    throw InputError(
        format("{:g} K at row {}, column {} is no temperature: expected above 0 K and at most {:g} K", value,
               k / width + 1, k % width + 1, kHottest_k));
  }
  find_blocks();
}

double TemperatureMap::at_k(const MapPosition& position) const {
  const MapGrid::Corners corners = grid_.corners_at(position);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += corners.share[k] * static_cast<double>(temperature_k_[corners.cell[k]]);
  return sum;
}

double TemperatureMap::minimum_k() const {
  return *std::min_element(temperature_k_.begin(), temperature_k_.end());
}
double TemperatureMap::maximum_k() const {
  return *std::max_element(temperature_k_.begin(), temperature_k_.end());
}

}  // namespace ifov::materials
